#include "reference/max_by_cells.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "reference/brick_samples.h"
#include "reference/cell_cue.h"
#include "reference/cell_rectangles.h"
#include "reference/tile_lists.h"
#include "reference/tile_rays.h"
#include "reference/visible_lines.h"

namespace nacre {
namespace {

constexpr int kBrick = BrightBricks::kSide;

/// What differs between an uncued and a cued picture: the unit of `best`, and what cells do to it.
///
/// Uncued: field units, from the map's first knot to its last; the map is applied at the end.
class PlainMaximum {
 public:
  PlainMaximum(const MaxByCells& scene, const CueField& cue)
      : kernel_(scene.kernel),
        emission_(scene.field->emission_of_field),
        factor_(std::max(0.0, cue.at_center)) {}

  static constexpr bool kOrdered = true;  ///< bricks come the brightest first

  double upper(const BrightBrick& brick) const { return std::min(brick.greatest, emission_.hi()); }
  double start(std::size_t, const PixelLine&, TileRays&) const { return emission_.lo(); }
  double shown(double best) const { return factor_ * emission_(best); }

  /// @return  the field that a cell of the brick must exceed for it to exceed `floor`
  double begin_brick(const BrightBrick&, double floor) const { return floor; }
  double upper_of_cell(double greatest) const { return std::min(greatest, emission_.hi()); }

  void raise(TileRays&, const LaneRays& lanes, const BrickSamples& samples, const BrickCell& cell,
             const LaneRectangle& rectangle) const {
    kernel_.raise_maxima(lanes, samples, cell, rectangle);
  }

 private:
  CellKernel kernel_;
  const EmissionMap& emission_;
  double factor_;
};

/// The least line from the first knot that the map stays below. Not a number where it is too steep
/// for one.
EmissionBound bound_of(const EmissionMap& map) {
  constexpr double kSafely = 1e-9;
  const EmissionKnot& first = map.knots().front();
  double slope = 0.0;
  for (const EmissionKnot& knot : map.knots().subspan(1)) {
    // Halves, since a difference of values may overflow.
    slope = std::max(
        slope, 0.5 * (knot.emission - first.emission) / (0.5 * knot.value - 0.5 * first.value));
  }
  const double at_0 = first.emission - slope * first.value;
  return {at_0 + kSafely * (1.0 + std::abs(at_0)), slope};
}

MapEnds ends_of(const EmissionMap& map) {
  const EmissionKnot& first = map.knots().front();
  const EmissionKnot& last = map.knots().back();
  const double width = last.value - first.value;
  return {first.value,    last.value,    width,
          first.emission, last.emission, map.knots().size() == 2 && std::isfinite(width)};
}

/// Cued: emission times cue.
class CuedMaximum {
 public:
  CuedMaximum(const MaxByCells& scene, const CueField& cue)
      : scene_(scene),
        cue_(cue),
        cell_cue_(*scene.field, cue),
        bound_(bound_of(scene.field->emission_of_field)),
        map_ends_(ends_of(scene.field->emission_of_field)) {}

  static constexpr bool kOrdered = false;

  double upper(const BrightBrick& brick) const {
    return brick.emission * cell_cue_.greatest(brick.first_cell, kBrick);
  }

  double start(std::size_t ray, const PixelLine& pixel, TileRays& rays) const {
    const EnteredLine entered{pixel.line, pixel.visible, pixel.t_shift_mm};
    const LineCue beta = scene_.field->along(cue_, Ray{{}, pixel.direction_mm}, entered);
    rays.set_cue(ray, beta);
    const double darkest = scene_.field->emission_of_field.knots().front().emission;
    if (darkest == 0.0) return 0.0;
    return darkest * std::max(beta(pixel.visible.t_enter), beta(pixel.visible.t_exit));
  }

  double shown(double best) const { return best; }

  double begin_brick(const BrightBrick& brick, double floor) {
    beta_of_brick_ = cell_cue_.greatest(brick.first_cell, kBrick);
    return least_field_above(scene_.field->emission_of_field, floor / beta_of_brick_);
  }
  double upper_of_cell(double greatest) const {
    if (!map_ends_.is_one_piece) return scene_.field->emission_of_field(greatest) * beta_of_brick_;
    const double on_line = bound_.at_0 + bound_.slope * greatest;
    return (on_line < map_ends_.top ? on_line : map_ends_.top) * beta_of_brick_;
  }

  void raise(TileRays& rays, const LaneRays& lanes, const BrickSamples& samples,
             const BrickCell& cell, const LaneRectangle& rectangle) const {
    struct Context {
      const CuedEmission& emission;
      const TileRays& rays;
      double* best;
    } context{*scene_.emission, rays, lanes.best};
    const auto visit = [](void* to, std::size_t ray, const CellPart& part) {
      const auto& [emission, cues, best] = *static_cast<const Context*>(to);
      const LineCue beta = cues.cue(ray);
      best[ray] = emission.maximum_above(best[ray], {{part.b[0], part.b[1], part.b[2], part.b[3]}},
                                         {beta(part.t_enter), beta(part.t_exit)});
    };
    scene_.kernel.visit_parts(lanes, samples, cell, rectangle, bound_, map_ends_,
                              {visit, &context});
  }

 private:
  const MaxByCells& scene_;
  CueField cue_;
  CellCue cell_cue_;
  EmissionBound bound_;
  MapEnds map_ends_;
  double beta_of_brick_ = 0.0;
};

/// A picture's frame for all tiles.
struct Frame {
  const MaxByCells& scene;
  const Camera& camera;
  const DepthCue& cue;
  const ToolRays* tools;
  CueField cue_field;
  PixelLines lines;
  CellRectangles rectangles;
  std::vector<PixelRange> of_brick;  ///< of each bright brick
  TileLists lists;
};

/// What a thread works with.
template <class Maximum>
struct Workplace {
  explicit Workplace(const Frame& frame) : maximum(frame.scene, frame.cue_field) {}

  Maximum maximum;
  TileRays rays;
  BrickSamples samples{};
  struct Item {
    double upper;
    std::uint32_t brick;
  };
  std::vector<Item> items;
};

LaneRectangle lanes_of(const PixelRange& pixels) {
  return {pixels.first.x, pixels.first.y, pixels.last.x + 1, pixels.last.y + 1};
}

PixelRange within(const PixelRange& tile, const PixelRange& r) {
  return {r.first - tile.first, r.last - tile.first};
}

/// The tile's bricks with what they can reach, the brightest first.
template <class Maximum>
void list_items(const Frame& frame, std::size_t tile, Workplace<Maximum>& work) {
  work.items.clear();
  for (const std::uint32_t i : frame.lists.of(tile)) {
    work.items.push_back({work.maximum.upper(frame.scene.bright->bricks[i]), i});
  }
  if constexpr (!Maximum::kOrdered) {
    std::stable_sort(work.items.begin(), work.items.end(),
                     [](const auto& a, const auto& b) { return a.upper > b.upper; });
  }
}

/// Sets up the rays of a tile. Tools are put into the picture on the way.
template <class Maximum>
void start_rays(const Frame& frame, const PixelRange& tile, Workplace<Maximum>& work,
                Picture& picture) {
  work.rays.clear();
  const bool dark = work.items.empty() && !frame.lines.shows_always();
  for_visible_lines(frame.lines, frame.camera, frame.cue, frame.tools, tile, picture,
                    [&](int x, int y, const PixelLine& line) {
                      if (dark) return;
                      const glm::ivec2 place = glm::ivec2(x, y) - tile.first;
                      const std::size_t ray = TileRays::index(place.x, place.y);
                      work.rays.put(place.x, place.y, line,
                                    work.maximum.start(ray, line, work.rays));
                    });
}

/// @param rectangle  the brick's, within the tile
/// @param floor      the least of what is seen there
template <class Maximum>
void draw_brick(const Frame& frame, const BrightBrick& brick, const PixelRange& tile,
                const PixelRange& rectangle, double floor, const LaneRays& lanes,
                Workplace<Maximum>& work) {
  load_samples(*frame.scene.field, brick.first_cell, work.samples);
  std::array<double, static_cast<std::size_t>(kBrick * kBrick * kBrick)> greatest;
  unsigned long long cells = frame.scene.kernel.greatest_corners(
      work.samples, work.maximum.begin_brick(brick, floor), greatest.data());
  cells &= cells_within(glm::ivec3(frame.scene.field->cells) - brick.first_cell);
  const CellRectangles::OfBrick rectangles(frame.rectangles, brick.first_cell, rectangle);
  for (; cells != 0; cells &= cells - 1) {
    const int cell = std::countr_zero(cells);
    const PixelRange pixels = within(tile, rectangles.cell(cell));
    if (pixels.empty()) continue;
    const double upper = work.maximum.upper_of_cell(greatest[static_cast<std::size_t>(cell)]);
    work.maximum.raise(work.rays, lanes, work.samples,
                       {cell % kBrick, cell / kBrick % kBrick, cell / kBrick / kBrick, upper},
                       lanes_of(pixels));
  }
}

template <class Maximum>
void draw_tile(const Frame& frame, std::size_t tile, Workplace<Maximum>& work, Picture& picture) {
  const PixelRange pixels = frame.lists.pixels(tile, TileRays::kSide, frame.camera.size);
  list_items(frame, tile, work);
  if (work.items.empty() && !frame.lines.shows_always() && !picture.tools) return;
  start_rays(frame, pixels, work, picture);
  const LaneRays lanes = work.rays.lanes();
  const auto least_best = [&](const PixelRange& where) {
    return frame.scene.kernel.least_best(lanes, lanes_of(within(pixels, where)));
  };
  constexpr std::size_t kBetweenLooks = 16;
  for (std::size_t i = 0; i < work.items.size(); ++i) {
    const double upper = work.items[i].upper;
    if (i % kBetweenLooks == 0 && !(upper > least_best(pixels))) break;
    const BrightBrick& bright = frame.scene.bright->bricks[work.items[i].brick];
    const PixelRange rectangle = intersection(frame.of_brick[work.items[i].brick], pixels);
    const double floor = least_best(rectangle);
    if (!(upper > floor)) continue;
    if (i + 1 < work.items.size()) {
      prefetch_samples(*frame.scene.field,
                       frame.scene.bright->bricks[work.items[i + 1].brick].first_cell);
    }
    draw_brick(frame, bright, pixels, rectangle, floor, lanes, work);
  }
  for (int y = pixels.first.y; y <= pixels.last.y; ++y) {
    for (int x = pixels.first.x; x <= pixels.last.x; ++x) {
      const double best = work.rays.best(x - pixels.first.x, y - pixels.first.y);
      if (std::isfinite(best)) {
        picture.volume.at(x, y) = static_cast<float>(work.maximum.shown(best));
      }
    }
  }
}

template <class Maximum>
void draw_tiles(const Frame& frame, Picture& picture, const ProgressCallback& progress) {
  const std::size_t tiles = frame.lists.begin.size() - 1;
  ProgressMeter meter(progress, "rays", tiles);
  tbb::enumerable_thread_specific<Workplace<Maximum>> workplaces(
      [&] { return Workplace<Maximum>(frame); });
  // Each tile is drawn by one thread alone, so the number of threads cannot show.
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, tiles, 1),
      [&](const auto& range) {
        for (std::size_t tile = range.begin(); tile != range.end(); ++tile) {
          draw_tile(frame, tile, workplaces.local(), picture);
          meter.advance();
        }
      },
      tbb::simple_partitioner());
}

}  // namespace

Picture max_picture_by_cells(const MaxByCells& scene, const Camera& camera, const DepthCue& cue,
                             const Slab& slab, const ToolRays* tools,
                             const ProgressCallback& progress) {
  const CellRectangles rectangles(*scene.field, camera);
  std::vector<PixelRange> of_brick = rectangles_of(*scene.bright, rectangles, camera.size);
  TileLists lists = make_tile_lists(of_brick, camera.size, TileRays::kSide);
  const Frame frame{scene,
                    camera,
                    cue,
                    tools,
                    nacre::cue_field(cue, camera),
                    PixelLines(*scene.field, camera, slab),
                    rectangles,
                    std::move(of_brick),
                    std::move(lists)};
  Picture picture = make_picture(camera, tools);
  if (is_flat(frame.cue_field)) {
    draw_tiles<PlainMaximum>(frame, picture, progress);
  } else {
    draw_tiles<CuedMaximum>(frame, picture, progress);
  }
  drop_unseen_tools(picture);
  return picture;
}

}  // namespace nacre

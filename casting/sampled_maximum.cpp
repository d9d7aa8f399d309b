#include "casting/sampled_maximum.h"

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "casting/cast_bricks.h"
#include "casting/cast_rays.h"
#include "casting/float_rounding.h"
#include "core/error.h"
#include "reference/bright_bricks.h"
#include "reference/cell_cue.h"
#include "reference/cell_rectangles.h"
#include "reference/exact_picture.h"
#include "reference/tile_lists.h"
#include "reference/tile_rays.h"
#include "reference/visible_lines.h"
#include "reference/walk_field.h"

namespace nacre {
namespace {

constexpr int kTile = BlockRays::kTile;

/// What is drawn, with the unit of `best`: the emission map's width, or with a cue emission.
struct Scene {
  const WalkField& field;
  const BrightBricks& bright;
  const CastBricks& bricks;
  int per_cell;
  SampleKernel kernel;
  CueField cue_field;
  bool cued;
  CellCue cue;
  CastScale scale;
  double width;  ///< of the emission map, field units
  float bottom;  ///< emission of its ends
  float top;
  double factor;  ///< of a cue that is the same everywhere

  /// The most that a ray can see of a brick.
  float upper(const BrightBrick& brick) const {
    if (!cued) return std::min(scale(brick.greatest), 1.0F);
    return static_cast<float>(brick.emission * cue.greatest(brick.first_cell, BrightBricks::kSide));
  }

  float shown(float best) const {
    if (cued) return best;
    const EmissionMap& map = field.emission_of_field;
    const double emission = map.knots().size() == 2
                                ? bottom + static_cast<double>(best) * (top - bottom)
                                : map(map.lo() + static_cast<double>(best) * width);
    return static_cast<float>(factor * emission);
  }
};

/// A picture's frame for all tiles.
struct Frame {
  const Scene& scene;
  const Camera& camera;
  const SampledMaximumOptions& options;
  PixelLines lines;
  std::vector<PixelRange> of_brick;  ///< of each bright brick
  TileLists lists;
  std::vector<CastAxes> axes;  ///< of each tile
};

/// What a thread works with.
struct Workplace {
  CastRays rays;
  BrickValues room;
  struct Item {
    float upper;
    std::uint32_t brick;
  };
  std::vector<Item> items;
};

/// The tile's bricks with what they can reach, the brightest first.
void list_items(const Frame& frame, std::size_t tile, Workplace& work) {
  work.items.clear();
  for (const std::uint32_t i : frame.lists.of(tile)) {
    work.items.push_back({frame.scene.upper(frame.scene.bright.bricks[i]), i});
  }
  if (!frame.scene.cued) return;  // in order as they are
  std::stable_sort(work.items.begin(), work.items.end(),
                   [](const auto& a, const auto& b) { return a.upper > b.upper; });
}

/// What a ray shows of a volume that is nowhere darker than the map's first knot.
float start_of(const Scene& scene, const PixelLine& pixel) {
  if (!scene.cued || scene.bottom == 0.0F) return 0.0F;
  const EnteredLine entered{pixel.line, pixel.visible, pixel.t_shift_mm};
  const LineCue beta = scene.field.along(scene.cue_field, Ray{{}, pixel.direction_mm}, entered);
  return static_cast<float>(scene.bottom *
                            std::max(beta(pixel.visible.t_enter), beta(pixel.visible.t_exit)));
}

/// Sets up the rays of a tile. Tools are put into the picture on the way.
void start_rays(const Frame& frame, const PixelRange& tile, Workplace& work, Picture& picture) {
  for_visible_lines(frame.lines, frame.camera, frame.options.cue, frame.options.tools, tile,
                    picture, [&](int x, int y, const PixelLine& line) {
                      work.rays.put(x - tile.first.x, y - tile.first.y, line,
                                    start_of(frame.scene, line));
                    });
}

BlockRectangle blocks_of(const PixelRange& pixels, const PixelRange& tile) {
  constexpr int kSide = BlockRays::kSide;
  const glm::ivec2 first = (pixels.first - tile.first) / kSide;
  const glm::ivec2 last = (pixels.last - tile.first) / kSide;
  return {first.x, first.y, last.x + 1, last.y + 1};
}

CastCue cue_at(const Scene& scene, const glm::ivec3& corner, const CastAxes& axes) {
  const glm::dvec3& rise = scene.cue.rise();
  return {scene.bottom,
          scene.top,
          static_cast<float>(scene.cue.at_origin() + glm::dot(rise, glm::dvec3(corner))),
          {static_cast<float>(rise[axes.u]), static_cast<float>(rise[axes.v]),
           static_cast<float>(rise[axes.plane])},
          static_cast<float>(scene.cue.greatest(corner, BrightBricks::kSide))};
}

/// A brick for rays that are steep to an axis; the volume's last plane is sampled by its last
/// brick.
CastBrick brick_of(const Scene& scene, std::uint32_t index, float upper, const CastAxes& axes,
                   BrickValues& room) {
  constexpr int kSide = CastBrick::kSamples;
  constexpr std::array<int, 3> kStep{1, kSide, kSide * kSide};
  const glm::ivec3& corner = scene.bright.bricks[index].first_cell;
  const glm::ivec3 left = glm::ivec3(scene.field.cells) - corner;
  const glm::ivec3 extent = glm::min(left, BrightBricks::kSide);
  const auto ends = [&](int axis) { return left[axis] <= BrightBricks::kSide ? 1U : 0U; };
  const auto begins = [&](int axis) { return corner[axis] == 0 ? 1U : 0U; };
  const unsigned faces =
      begins(axes.u) | ends(axes.u) << 1 | begins(axes.v) << 2 | ends(axes.v) << 3;
  return {scene.bricks.samples(index, room),
          {kStep[axes.u], kStep[axes.v], kStep[axes.plane]},
          {static_cast<float>(corner[axes.u]), static_cast<float>(corner[axes.v]),
           static_cast<float>(corner[axes.plane])},
          {static_cast<float>(extent[axes.u]), static_cast<float>(extent[axes.v]),
           static_cast<float>(extent[axes.plane])},
          faces,
          extent[axes.plane] * scene.per_cell + static_cast<int>(ends(axes.plane)),
          scene.per_cell,
          upper};
}

void draw_bricks(const Frame& frame, const PixelRange& tile, Workplace& work) {
  const Scene& scene = frame.scene;
  const CastAxes& axes = work.rays.axes();
  const BlockRays lanes = work.rays.lanes(static_cast<double>(scene.field.cells[axes.plane]));
  const auto least_best = [&](const BlockRectangle& where) {
    return scene.kernel.least_best(lanes, where);
  };
  constexpr std::size_t kBetweenLooks = 16;
  for (std::size_t i = 0; i < work.items.size(); ++i) {
    const auto [upper, index] = work.items[i];
    if (i % kBetweenLooks == 0 && !(upper > least_best(blocks_of(tile, tile)))) break;
    const BlockRectangle where = blocks_of(intersection(frame.of_brick[index], tile), tile);
    if (!(upper > least_best(where))) continue;
    if (i + 1 < work.items.size()) {
      scene.bricks.prefetch(work.items[i + 1].brick);
    }
    const glm::ivec3& corner = scene.bright.bricks[index].first_cell;
    const CastBrick brick = brick_of(scene, index, upper, axes, work.room);
    if (scene.cued) {
      const CastCue cue = cue_at(scene, corner, axes);
      scene.kernel.raise(lanes, brick, where, &cue);
    } else {
      scene.kernel.raise(lanes, brick, where, nullptr);
    }
  }
}

/// @param uncut  all rays, where nothing cuts them off
void draw_tile(const Frame& frame, std::size_t tile, const std::optional<ParallelLines>& uncut,
               Workplace& work, Picture& picture) {
  const PixelRange pixels = frame.lists.pixels(tile, kTile, frame.camera.size);
  list_items(frame, tile, work);
  if (work.items.empty() && !frame.lines.shows_always() && !picture.tools) return;
  work.rays.clear(frame.axes[tile]);
  if (uncut) {
    work.rays.put_parallel(*uncut, pixels);
  } else {
    start_rays(frame, pixels, work, picture);
  }
  draw_bricks(frame, pixels, work);
  for (int y = pixels.first.y; y <= pixels.last.y; ++y) {
    for (int x = pixels.first.x; x <= pixels.last.x; ++x) {
      const float best = work.rays.best(x - pixels.first.x, y - pixels.first.y);
      if (std::isfinite(best)) picture.volume.at(x, y) = frame.scene.shown(best);
    }
  }
}

void draw_tiles(const Frame& frame, Picture& picture, const ProgressCallback& progress) {
  const std::size_t tiles = frame.axes.size();
  const std::optional<ParallelLines> uncut = picture.tools ? std::nullopt : frame.lines.uncut();
  ProgressMeter meter(progress, "rays", tiles);
  tbb::enumerable_thread_specific<Workplace> workplaces;
  // Each tile is drawn by one thread alone, so the number of threads cannot show.
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, tiles, 1),
      [&](const auto& range) {
        for (std::size_t tile = range.begin(); tile != range.end(); ++tile) {
          draw_tile(frame, tile, uncut, workplaces.local(), picture);
          meter.advance();
        }
      },
      tbb::simple_partitioner());
}

void check(const SampledMaximumOptions& options) {
  check_cue(options.cue);
  check_slab(options.slab);
  if (options.per_cell < 1 || options.per_cell > kMostSamplesPerCell) {
    throw Error(ErrorCode::BadArgument, fmt::format("samples a voxel: found {}, expected 1 to {}",
                                                    options.per_cell, kMostSamplesPerCell));
  }
}

void check_pieces(const EmissionMap& map) {
  const std::size_t pieces = map.knots().size() - 1;
  if (pieces == 1) return;
  throw Error(ErrorCode::Unsupported,
              fmt::format("a sampled maximum under a cue: found an emission map of {} pieces, "
                          "expected one (the exact maximum takes any)",
                          pieces));
}

}  // namespace

SampledMaximum::SampledMaximum(const ExactWalk& walk) : walk_(&walk) {
  constexpr double kMostRounding = 0.01;
  const WalkField& field = walk.field();
  if (!(rounding_to_floats(field) <= kMostRounding)) return;
  bricks_ = std::make_unique<const CastBricks>(field, walk.bright_bricks(),
                                               cast_scale(field.emission_of_field));
}

SampledMaximum::~SampledMaximum() = default;
SampledMaximum::SampledMaximum(SampledMaximum&&) noexcept = default;

bool SampledMaximum::takes_samples(const Camera& camera, const DepthCue& cue) const {
  const WalkField& field = walk_->field();
  return bricks_ && floats_hold(field, CellCue(field, cue_field(cue, camera))) &&
         axes_of_tiles(field, camera);
}

Picture SampledMaximum::picture(const Camera& camera, const SampledMaximumOptions& options,
                                const ProgressCallback& progress) const {
  check(options);
  const WalkField& field = walk_->field();
  const CueField cue = cue_field(options.cue, camera);
  const CellCue cell_cue(field, cue);
  auto axes = bricks_ && floats_hold(field, cell_cue) ? axes_of_tiles(field, camera) : std::nullopt;
  if (!axes) {
    return exact_picture(*walk_, camera,
                         {.cue = options.cue, .slab = options.slab, .tools = options.tools},
                         progress);
  }
  const EmissionMap& map = field.emission_of_field;
  const bool cued = !is_flat(cue);
  if (cued) check_pieces(map);
  const BrightBricks& bright = walk_->bright_bricks();
  const CellRectangles rectangles(field, camera);
  std::vector<PixelRange> of_brick = rectangles_of(bright, rectangles, camera.size);
  TileLists lists = make_tile_lists(of_brick, camera.size, kTile);
  const Scene scene{field,
                    bright,
                    *bricks_,
                    options.per_cell,
                    sample_kernel_for(options.instructions),
                    cue,
                    cued,
                    cell_cue,
                    cast_scale(map),
                    map.hi() - map.lo(),
                    static_cast<float>(map.knots().front().emission),
                    static_cast<float>(map.knots().back().emission),
                    std::max(0.0, cue.at_center)};
  const Frame frame{scene,
                    camera,
                    options,
                    PixelLines(field, camera, options.slab),
                    std::move(of_brick),
                    std::move(lists),
                    std::move(*axes)};
  Picture picture = make_picture(camera, options.tools);
  draw_tiles(frame, picture, progress);
  drop_unseen_tools(picture);
  return picture;
}

}  // namespace nacre

#include "reference/exact_picture.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "core/error.h"
#include "reference/max_by_cells.h"

namespace nacre {
namespace {

/// What a ray shows over an interval.
using RayValue = std::function<double(const Ray&, const RayInterval&)>;

void check(const ExactPictureOptions& options) {
  check_cue(options.cue);
  check_slab(options.slab);
}

/// The volume's part of a pixel: the ray's visible interval, cut off at the nearest tool, which is
/// put into its layer on the way.
double pixel_value(const RayValue& value, const Camera& camera, const ExactPictureOptions& options,
                   int x, int y, std::optional<ToolLayer>& tools) {
  const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
  RayInterval interval = visible_interval(camera, ray, options.slab);
  if (tools) {
    const double t_tool = draw_tool_pixel(*options.tools, camera, options.cue, ray, x, y, *tools);
    interval.t_end_mm = std::min(interval.t_end_mm, t_tool);
  }
  return value(ray, interval);
}

/// One ray a pixel, on all cores.
Picture picture_of(const RayValue& value, const Camera& camera, const ExactPictureOptions& options,
                   const ProgressCallback& progress) {
  const auto [width, height] = std::pair(camera.size.x, camera.size.y);
  Picture picture = make_picture(camera, options.tools);
  ProgressMeter meter(progress, "rays", picture.volume.pixels.size());
  // Square tiles: neighbouring rays share cells. Each pixel is computed alone, so the order and the
  // number of threads cannot show.
  constexpr int kTile = 16;
  tbb::parallel_for(
      tbb::blocked_range2d<int>(0, height, kTile, 0, width, kTile),
      [&](const tbb::blocked_range2d<int>& tile) {
        for (int y = tile.rows().begin(); y != tile.rows().end(); ++y) {
          for (int x = tile.cols().begin(); x != tile.cols().end(); ++x) {
            picture.volume.at(x, y) =
                static_cast<float>(pixel_value(value, camera, options, x, y, picture.tools));
          }
        }
        meter.advance(tile.rows().size() * tile.cols().size());
      },
      tbb::simple_partitioner());
  drop_unseen_tools(picture);
  return picture;
}

double lit_surface(const LayerWalk& layers, const Camera& camera, const DepthCue& cue,
                   const Ray& ray, const RayInterval& interval) {
  const auto hit = layers.first_surface(ray, interval);
  if (!hit) return 0.0;
  const double z = depth_z(camera, ray.origin_mm + hit->t_mm * ray.direction);
  return headlight(-glm::dot(hit->normal, ray.direction)) * std::max(0.0, beta(cue, z));
}

/// Count and iso, which show the same of the volume and of ideal shells.
Picture crossing_picture(const LayerWalk& layers, const Camera& camera,
                         const ExactPictureOptions& options, const ProgressCallback& progress) {
  const auto count = [&](const Ray& ray, const RayInterval& interval) {
    return layers.count(ray, interval);
  };
  const auto iso = [&](const Ray& ray, const RayInterval& interval) {
    return lit_surface(layers, camera, options.cue, ray, interval);
  };
  return options.mode == PictureMode::Count ? picture_of(count, camera, options, progress)
                                            : picture_of(iso, camera, options, progress);
}

/// Max and sum of ideal shells, and sum of the volume.
template <class Walk>
Picture emission_picture(const Walk& walk, const Camera& camera, const ExactPictureOptions& options,
                         const ProgressCallback& progress) {
  const CueField cue = cue_field(options.cue, camera);
  const auto max = [&](const Ray& ray, const RayInterval& interval) {
    return walk.max_emission(ray, interval, cue);
  };
  const auto sum = [&](const Ray& ray, const RayInterval& interval) {
    return walk.emission_integral(ray, interval, cue);
  };
  return options.mode == PictureMode::Max ? picture_of(max, camera, options, progress)
                                          : picture_of(sum, camera, options, progress);
}

Picture max_picture(const ExactWalk& walk, const Camera& camera, const ExactPictureOptions& options,
                    const ProgressCallback& progress) {
  return max_picture_by_cells({&walk.field(), &walk.bright_bricks(), &walk.cued_emission()}, camera,
                              options.cue, options.slab, options.tools, progress);
}

bool shows_crossings(PictureMode mode) {
  return mode == PictureMode::Count || mode == PictureMode::Iso;
}

}  // namespace

Picture exact_picture(const ExactWalk& walk, const Camera& camera,
                      const ExactPictureOptions& options, const ProgressCallback& progress) {
  check(options);
  if (options.mode == PictureMode::Max) return max_picture(walk, camera, options, progress);
  if (!shows_crossings(options.mode)) return emission_picture(walk, camera, options, progress);
  return crossing_picture(LayerWalk(walk, options.levels), camera, options, progress);
}

Picture ideal_picture(const ExactWalk& walk, const Camera& camera,
                      const ExactPictureOptions& options, const ProgressCallback& progress) {
  check(options);
  const LayerWalk layers(walk, options.levels);
  return shows_crossings(options.mode) ? crossing_picture(layers, camera, options, progress)
                                       : emission_picture(layers, camera, options, progress);
}

}  // namespace nacre

#include "reference/exact_picture.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <functional>
#include <glm/geometric.hpp>

#include "core/error.h"

namespace nacre {
namespace {

/// What a ray shows over an interval.
using RayValue = std::function<double(const Ray&, const RayInterval&)>;

void check(const ExactPictureOptions& options) {
  check_cue(options.cue);
  check_slab(options.slab);
}

/// One ray a pixel, on all cores.
Image picture_of(const RayValue& value, const Camera& camera, const Slab& slab,
                 const ProgressCallback& progress) {
  Image image = make_image(camera.size.x, camera.size.y);
  ProgressMeter meter(progress, "rays", image.pixels.size());
  // Square tiles: neighbouring rays share cells. Each pixel is computed alone, so the order and the
  // number of threads cannot show.
  constexpr int kTile = 16;
  tbb::parallel_for(
      tbb::blocked_range2d<int>(0, image.height, kTile, 0, image.width, kTile),
      [&](const tbb::blocked_range2d<int>& tile) {
        for (int y = tile.rows().begin(); y != tile.rows().end(); ++y) {
          for (int x = tile.cols().begin(); x != tile.cols().end(); ++x) {
            const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
            image.at(x, y) = static_cast<float>(value(ray, visible_interval(camera, ray, slab)));
          }
        }
        meter.advance(tile.rows().size() * tile.cols().size());
      },
      tbb::simple_partitioner());
  return image;
}

double lit_surface(const LayerWalk& layers, const Camera& camera, const DepthCue& cue,
                   const Ray& ray, const RayInterval& interval) {
  const auto hit = layers.first_surface(ray, interval);
  if (!hit) return 0.0;
  const double z = depth_z(camera, ray.origin_mm + hit->t_mm * ray.direction);
  return headlight(-glm::dot(hit->normal, ray.direction)) * std::max(0.0, beta(cue, z));
}

/// Count and iso, which show the same of the volume and of ideal shells.
Image crossing_picture(const LayerWalk& layers, const Camera& camera,
                       const ExactPictureOptions& options, const ProgressCallback& progress) {
  const auto count = [&](const Ray& ray, const RayInterval& interval) {
    return layers.count(ray, interval);
  };
  const auto iso = [&](const Ray& ray, const RayInterval& interval) {
    return lit_surface(layers, camera, options.cue, ray, interval);
  };
  return options.mode == PictureMode::Count ? picture_of(count, camera, options.slab, progress)
                                            : picture_of(iso, camera, options.slab, progress);
}

/// Max and sum, of what has both (ExactWalk, LayerWalk).
template <class Walk>
Image emission_picture(const Walk& walk, const Camera& camera, const ExactPictureOptions& options,
                       const ProgressCallback& progress) {
  const CueField cue = cue_field(options.cue, camera);
  const auto max = [&](const Ray& ray, const RayInterval& interval) {
    return walk.max_emission(ray, interval, cue);
  };
  const auto sum = [&](const Ray& ray, const RayInterval& interval) {
    return walk.emission_integral(ray, interval, cue);
  };
  return options.mode == PictureMode::Max ? picture_of(max, camera, options.slab, progress)
                                          : picture_of(sum, camera, options.slab, progress);
}

bool shows_crossings(PictureMode mode) {
  return mode == PictureMode::Count || mode == PictureMode::Iso;
}

}  // namespace

Image exact_picture(const ExactWalk& walk, const Camera& camera, const ExactPictureOptions& options,
                    const ProgressCallback& progress) {
  check(options);
  if (!shows_crossings(options.mode)) return emission_picture(walk, camera, options, progress);
  return crossing_picture(LayerWalk(walk, options.levels), camera, options, progress);
}

Image ideal_picture(const ExactWalk& walk, const Camera& camera, const ExactPictureOptions& options,
                    const ProgressCallback& progress) {
  check(options);
  const LayerWalk layers(walk, options.levels);
  return shows_crossings(options.mode) ? crossing_picture(layers, camera, options, progress)
                                       : emission_picture(layers, camera, options, progress);
}

}  // namespace nacre

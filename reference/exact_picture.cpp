#include "reference/exact_picture.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include "core/error.h"

namespace nacre {
namespace {

void check(const ExactPictureOptions& options) {
  if (options.mode != PictureMode::Max && options.mode != PictureMode::Sum) {
    throw Error(ErrorCode::BadArgument,
                "exact picture: found a mode of shells, expected max or sum");
  }
  check_slab(options.slab);
}

}  // namespace

Image exact_picture(const ExactWalk& walk, const Camera& camera, const ExactPictureOptions& options,
                    const ProgressCallback& progress) {
  check(options);
  Image image = make_image(camera.size.x, camera.size.y);
  ProgressMeter meter(progress, "rays", image.pixels.size());
  const auto pixel = [&](int x, int y) {
    const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
    const RayInterval interval = visible_interval(camera, ray, options.slab);
    return options.mode == PictureMode::Max ? walk.max_emission(ray, interval)
                                            : walk.emission_integral(ray, interval);
  };
  // Square tiles: neighbouring rays share cells. Each pixel is computed alone, so the order and the
  // number of threads cannot show.
  constexpr int kTile = 16;
  tbb::parallel_for(
      tbb::blocked_range2d<int>(0, image.height, kTile, 0, image.width, kTile),
      [&](const tbb::blocked_range2d<int>& tile) {
        for (int y = tile.rows().begin(); y != tile.rows().end(); ++y) {
          for (int x = tile.cols().begin(); x != tile.cols().end(); ++x) {
            image.at(x, y) = static_cast<float>(pixel(x, y));
          }
        }
        meter.advance(tile.rows().size() * tile.cols().size());
      },
      tbb::simple_partitioner());
  return image;
}

}  // namespace nacre

// The silhouette of a volume's box against the walk that decides which rays meet it.
#include <gtest/gtest.h>

#include <cstdint>
#include <glm/ext/matrix_transform.hpp>
#include <random>

#include "core/volume_silhouette.h"
#include "reference/exact_picture.h"
#include "reference/exact_walk.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

TEST(Silhouette, HoldsWhatTheExactPictureOfABrightVolumeLights) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const glm::i64vec3& dims : {glm::i64vec3(9, 7, 5), glm::i64vec3(12, 1, 3)}) {
    Volume volume = testing::volume_of<std::uint8_t>(dims, [](auto, auto, auto) { return 1; });
    volume.world_from_voxel =
        glm::rotate(glm::translate(glm::dmat4(1.0), {300.0, -20.0, 5.0}), 0.4, {1.0, 2.0, 3.0}) *
        glm::scale(glm::dmat4(1.0), {0.7, 1.0, 1.9});
    volume.world_from_voxel[1] += 0.2 * volume.world_from_voxel[0];
    const ExactWalk walk(volume, EmissionMap::window(0, 1));
    for (int view = 0; view < 60; ++view) {
      CameraOptions options{.size = {47, 40},
                            .azimuth_rad = 7.0 * unit(random),
                            .elevation_rad = 2.0 * unit(random) - 1.0,
                            .roll_rad = unit(random),
                            .zoom = view % 4 == 0 ? 2.5 : 0.9};
      if (view % 2 == 1) {
        options.field_of_view_rad = 0.3 + unit(random);
        if (view % 3 == 0) options.distance_mm = 8.0 * unit(random);
      }
      const Camera camera = testing::camera_of(volume, options);
      const auto spans = volume_silhouette(camera, dims, volume.world_from_voxel);
      for (const PictureMode mode : {PictureMode::Max, PictureMode::Sum}) {
        const Image exact = exact_picture(walk, camera, {.mode = mode}).volume;
        for (int y = 0; y < exact.height; ++y) {
          const PixelSpan& span = spans[static_cast<std::size_t>(y)];
          for (int x = 0; x < exact.width; ++x) {
            ASSERT_EQ(exact.at(x, y) > 0.0F, x >= span.first && x < span.end)
                << x << ", " << y << " of view " << view;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace nacre

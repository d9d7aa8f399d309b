#include "reference/exact_picture.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "tests/support/fine_march.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::FineMarch;
using testing::random_volume;
using testing::volume_of;

constexpr double kDegree = std::numbers::pi / 180.0;
const EmissionMap kUnit = EmissionMap::window(0.0, 1.0);

Camera camera_of(const Volume& volume, CameraOptions options) {
  return make_camera(options, bounding_sphere(volume.dims, volume.world_from_voxel));
}

TEST(ExactPicture, NamedViewsPlaceAMarkedVoxelWhereThePatientHasIt) {
  // Bright at the patient's left, front and top: voxel axes are L, P, S here.
  const Volume volume = volume_of<std::uint8_t>(
      {9, 9, 9}, [](auto x, auto y, auto z) { return x == 8 && y == 0 && z == 8 ? 1 : 0; });
  const ExactWalk walk(volume, kUnit);
  struct Expected {
    NamedView view;
    bool right;  // half of the picture
    bool top;
  };
  for (const auto& [view, right, top] :
       {Expected{NamedView::Anterior, true, true}, Expected{NamedView::Posterior, false, true},
        Expected{NamedView::Left, false, true}, Expected{NamedView::Right, true, true},
        Expected{NamedView::Superior, false, true}, Expected{NamedView::Inferior, true, true}}) {
    const Image image = exact_picture(walk, camera_of(volume, {.size = {32, 32}, .view = view}));
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        if (image.at(x, y) <= 0.1f) continue;
        EXPECT_EQ(x >= 16, right) << name(view);
        EXPECT_EQ(y < 16, top) << name(view);
      }
    }
  }
}

TEST(ExactPicture, AgreesWithAMarchFromTurnedAndPerspectiveCameras) {
  Volume volume = random_volume<std::uint8_t>({12, 9, 7}, 0, 255);
  volume.world_from_voxel[0] = {0.5, 0.1, 0.0, 0.0};
  volume.world_from_voxel[1] = {-0.1, 0.5, 0.1, 0.0};
  volume.world_from_voxel[2] = {0.0, -0.2, 1.0, 0.0};
  volume.world_from_voxel[3] = {-30.0, 50.0, 7.0, 1.0};
  const EmissionMap map = EmissionMap::window(40.0, 230.0);
  const ExactWalk walk(volume, map);
  const FineMarch march(volume, map, 0.005);
  for (const CameraOptions& options :
       {CameraOptions{.size = {7, 5}, .azimuth_rad = 30 * kDegree, .elevation_rad = -20 * kDegree},
        CameraOptions{.size = {5, 7}, .roll_rad = 1.0, .field_of_view_rad = 60 * kDegree},
        CameraOptions{
            .size = {6, 6}, .zoom = 2.0, .field_of_view_rad = 90 * kDegree, .distance_mm = 0.7}}) {
    const Camera camera = camera_of(volume, options);
    const Image most = exact_picture(walk, camera, {.mode = PictureMode::Max});
    const Image sum = exact_picture(walk, camera, {.mode = PictureMode::Sum});
    for (int y = 0; y < camera.size.y; ++y) {
      for (int x = 0; x < camera.size.x; ++x) {
        const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
        const double begin = camera.perspective ? 0.0 : -20.0;
        EXPECT_NEAR(most.at(x, y), march.max_emission(ray, begin, 40.0), 5e-3);
        EXPECT_NEAR(sum.at(x, y), march.emission_integral(ray, begin, 40.0), 1e-2);
      }
    }
  }
}

TEST(ExactPicture, SlabsAddUpToTheWholeIntegral) {
  const Volume volume = random_volume<float>({9, 9, 9}, 0.0, 1.0);
  const ExactWalk walk(volume, kUnit);
  for (const CameraOptions& options :
       {CameraOptions{.size = {16, 16}, .azimuth_rad = 0.4},
        CameraOptions{.size = {16, 16}, .field_of_view_rad = 50 * kDegree}}) {
    const Camera camera = camera_of(volume, options);
    const Image whole = exact_picture(walk, camera, {.mode = PictureMode::Sum});
    const Image near = exact_picture(
        walk, camera, {.mode = PictureMode::Sum, .slab = {.near_mm = -1e9, .far_mm = 1.5}});
    const Image far = exact_picture(
        walk, camera, {.mode = PictureMode::Sum, .slab = {.near_mm = 1.5, .far_mm = 1e9}});
    for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
      EXPECT_NEAR(near.pixels[i] + far.pixels[i], whole.pixels[i], 1e-5);
    }
  }
}

TEST(ExactPicture, IsTheSameForAnyNumberOfThreads) {
  const Volume volume = random_volume<std::int16_t>({40, 30, 20}, -100, 100);
  const EmissionMap map = EmissionMap::window(0.0, 100.0);
  const auto picture = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const ExactWalk walk(volume, map);
    return exact_picture(walk, camera_of(volume, {.size = {65, 43}}), {.mode = PictureMode::Sum});
  };
  EXPECT_EQ(picture(1).pixels, picture(4).pixels);
}

TEST(ExactPicture, RefusesModesOfShellsAndEmptySlabs) {
  const Volume volume = random_volume<float>({2, 2, 2}, 0.0, 1.0);
  const ExactWalk walk(volume, kUnit);
  const Camera camera = camera_of(volume, {.size = {2, 2}});
  EXPECT_THROW(exact_picture(walk, camera, {.mode = PictureMode::Count}), Error);
  EXPECT_THROW(exact_picture(walk, camera, {.slab = {.near_mm = 2, .far_mm = 1}}), Error);
}

}  // namespace
}  // namespace nacre

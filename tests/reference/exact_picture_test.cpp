#include "reference/exact_picture.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "tests/support/fine_march.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::camera_of;
using testing::FineMarch;
using testing::random_volume;
using testing::volume_of;

constexpr double kDegree = std::numbers::pi / 180.0;
const EmissionMap kUnit = EmissionMap::window(0.0, 1.0);

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
    const Image image =
        exact_picture(walk, camera_of(volume, {.size = {32, 32}, .view = view})).volume;
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
    const Image most = exact_picture(walk, camera, {.mode = PictureMode::Max}).volume;
    const Image sum = exact_picture(walk, camera, {.mode = PictureMode::Sum}).volume;
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
    const Image whole = exact_picture(walk, camera, {.mode = PictureMode::Sum}).volume;
    const Image near =
        exact_picture(walk, camera,
                      {.mode = PictureMode::Sum, .slab = {.near_mm = -1e9, .far_mm = 1.5}})
            .volume;
    const Image far =
        exact_picture(walk, camera,
                      {.mode = PictureMode::Sum, .slab = {.near_mm = 1.5, .far_mm = 1e9}})
            .volume;
    for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
      EXPECT_NEAR(near.pixels[i] + far.pixels[i], whole.pixels[i], 1e-5);
    }
  }
}

// Depth runs along the viewing direction, also for the oblique rays of a perspective camera, and
// slabs cut it; the march weights its samples by `depth_z` itself.
TEST(ExactPicture, CuesAndSlabsAgreeWithAMarch) {
  const Volume volume = random_volume<std::uint8_t>({12, 9, 7}, 0, 255);
  const EmissionMap map = EmissionMap::window(40.0, 230.0);
  const ExactWalk walk(volume, map);
  const FineMarch march(volume, map, 0.005);
  for (const DepthCue& cue : {DepthCue{0.9, 0.1, 0.0}, DepthCue{-0.7, 0.5, 0.2}}) {
    for (const CameraOptions& options :
         {CameraOptions{.size = {6, 5}, .azimuth_rad = 30 * kDegree},
          CameraOptions{.size = {5, 6}, .roll_rad = 1.0, .field_of_view_rad = 70 * kDegree}}) {
      const Camera camera = camera_of(volume, options);
      const Slab slab{-3.0, 2.5};
      const auto weight = [&](const glm::dvec3& p) {
        const double depth = slab_depth_mm(camera, p);
        return depth < slab.near_mm || depth > slab.far_mm ? 0.0 : beta(cue, depth_z(camera, p));
      };
      const Image most = exact_picture(walk, camera, {.cue = cue, .slab = slab}).volume;
      const Image sum =
          exact_picture(walk, camera, {.mode = PictureMode::Sum, .cue = cue, .slab = slab}).volume;
      for (int y = 0; y < camera.size.y; ++y) {
        for (int x = 0; x < camera.size.x; ++x) {
          const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
          const double begin = camera.perspective ? 0.0 : -20.0;
          EXPECT_NEAR(most.at(x, y), march.max_emission(ray, begin, 40.0, weight), 5e-3);
          EXPECT_NEAR(sum.at(x, y), march.emission_integral(ray, begin, 40.0, weight), 1e-2);
        }
      }
    }
  }
}

TEST(ExactPicture, WithoutACueIsTheUncuedPictureBitForBit) {
  const Volume volume = random_volume<std::int16_t>({20, 30, 20}, -100, 100);
  const ExactWalk walk(volume, EmissionMap::window(0.0, 100.0));
  const Camera camera = camera_of(volume, {.size = {33, 21}, .azimuth_rad = 0.3});
  for (const PictureMode mode : {PictureMode::Max, PictureMode::Sum}) {
    const Image plain = exact_picture(walk, camera, {.mode = mode}).volume;
    EXPECT_EQ(exact_picture(walk, camera, {.mode = mode, .cue = {0.0, 1.0, 0.0}}).volume.pixels,
              plain.pixels);
    const Image half = exact_picture(walk, camera, {.mode = mode, .cue = {0.0, 0.25, 0.25}}).volume;
    for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
      EXPECT_EQ(half.pixels[i], 0.5f * plain.pixels[i]);
    }
  }
}

/// v = 1 - |p - center| / 10 on 21 samples a side, 1 mm apart; the ball of level 1/2 has radius 5.
Volume ball() {
  return volume_of<double>({21, 21, 21}, [](auto x, auto y, auto z) {
    return std::max(0.0, 1.0 - glm::length(glm::dvec3(x - 10, y - 10, z - 10)) / 10.0);
  });
}

TEST(ExactPicture, IsoIsALitBall) {
  const Volume volume = ball();
  const ExactWalk walk(volume, kUnit);
  const Camera camera = camera_of(volume, {.size = {41, 41}, .zoom = 2.5});
  const DepthCue cue{0.8, 0.2, 0.0};
  const Image lit =
      exact_picture(walk, camera, {.mode = PictureMode::Iso, .cue = cue, .levels = {{0.5, 1.0}}})
          .volume;
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x) {
      const glm::dvec2 offset = camera.half_extent * picture_offset(camera, x + 0.5, y + 0.5);
      const double off_axis = glm::length(offset);
      if (off_axis > 5.2) {
        EXPECT_EQ(lit.at(x, y), 0.0f);
      }
      if (off_axis > 4.0) continue;  // the grid's facets show at the rim
      const double height = std::sqrt(25.0 - off_axis * off_axis);
      const double z = 0.5 + 0.5 * height / camera.sphere.radius_mm;
      EXPECT_NEAR(lit.at(x, y), headlight(height / 5.0) * beta(cue, z), 0.05);
    }
  }
}

TEST(ExactPicture, ASurfaceMetFromInsideIsTurnedAway) {
  const Volume volume = ball();
  const ExactWalk walk(volume, kUnit);
  const std::vector<ShownLevel> half{{0.5, 1.0}};
  // The slab begins at the ball's centre; or the eye stands there.
  const Camera outside = camera_of(volume, {.size = {9, 9}, .zoom = 8.0});
  const Camera inside =
      camera_of(volume, {.size = {9, 9}, .field_of_view_rad = 60 * kDegree, .distance_mm = 0.0});
  const ExactPictureOptions sliced{
      .mode = PictureMode::Iso, .slab = {.near_mm = 0.0}, .levels = half};
  const ExactPictureOptions whole{.mode = PictureMode::Iso, .levels = half};
  for (const float pixel : exact_picture(walk, outside, sliced).volume.pixels) {
    EXPECT_FLOAT_EQ(pixel, static_cast<float>(kAmbient));
  }
  for (const float pixel : exact_picture(walk, inside, whole).volume.pixels) {
    EXPECT_FLOAT_EQ(pixel, static_cast<float>(kAmbient));
  }
}

TEST(ExactPicture, AFlatFieldHasNoNormalAndIsAmbient) {
  // One plateau at the level itself: its cap is lit, the surface behind it has no gradient.
  const Volume volume = volume_of<std::uint8_t>({5, 5, 5}, [](auto, auto, auto) { return 1; });
  const ExactWalk walk(volume, kUnit);
  const Camera camera = camera_of(volume, {.size = {3, 3}, .zoom = 8.0});
  const ExactPictureOptions options{.mode = PictureMode::Iso, .levels = {{0.5, 1.0}}};
  for (const float pixel : exact_picture(walk, camera, options).volume.pixels) {
    EXPECT_FLOAT_EQ(pixel, 1.0f);  // the cap faces the eye
  }
}

/// A square across the view, at a depth along +y.
Tool screen(double y, double half_side) {
  const auto h = static_cast<float>(half_side);
  const auto at = static_cast<float>(y);
  Tool tool;
  tool.mesh.positions = {
      {10 - h, at, 10 - h}, {10 + h, at, 10 - h}, {10 + h, at, 10 + h}, {10 - h, at, 10 + h}};
  tool.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  tool.color = {0.5f, 0.25f, 1.0f};
  return tool;
}

TEST(ExactPicture, AToolCutsWhatASlabWouldCut) {
  const Volume volume = ball();
  const ExactWalk walk(volume, kUnit);
  // Anterior: the eye looks along +y; the screen stands 2 mm behind the centre.
  const std::vector<Tool> tools{screen(12.0, 100.0)};
  const ToolRays rays(tools);
  const DepthCue cue{0.5, 0.5, 0.0};
  for (const CameraOptions& view :
       {CameraOptions{.size = {17, 17}},
        CameraOptions{.size = {17, 17}, .field_of_view_rad = 40 * kDegree}}) {
    const Camera camera = camera_of(volume, view);
    for (const PictureMode mode :
         {PictureMode::Max, PictureMode::Sum, PictureMode::Count, PictureMode::Iso}) {
      ExactPictureOptions options{.mode = mode, .cue = cue, .levels = {{0.3, 0.4}, {0.6, 0.9}}};
      ExactPictureOptions sliced = options;
      options.tools = &rays;
      sliced.slab.far_mm = 2.0;
      const Picture with_tool = exact_picture(walk, camera, options);
      const Picture with_slab = exact_picture(walk, camera, sliced);
      ASSERT_TRUE(with_tool.tools.has_value());
      EXPECT_FALSE(with_slab.tools.has_value());
      for (std::size_t i = 0; i < with_tool.volume.pixels.size(); ++i) {
        EXPECT_NEAR(with_tool.volume.pixels[i], with_slab.volume.pixels[i], 1e-5);
        EXPECT_EQ(with_tool.tools->covered[i], 1);
      }
      const Picture ideal = ideal_picture(walk, camera, options);
      const Picture ideal_sliced = ideal_picture(walk, camera, sliced);
      for (std::size_t i = 0; i < ideal.volume.pixels.size(); ++i) {
        EXPECT_NEAR(ideal.volume.pixels[i], ideal_sliced.volume.pixels[i], 1e-5);
      }
    }
  }
}

TEST(ExactPicture, SlabsDoNotCutTools) {
  const Volume volume = ball();
  const ExactWalk walk(volume, kUnit);
  const std::vector<Tool> tools{screen(1.0, 3.0)};  // before the slab, in the middle of the picture
  const ToolRays rays(tools);
  const Camera camera = camera_of(volume, {.size = {17, 17}});
  const Picture picture = exact_picture(
      walk, camera, {.cue = {1.0, 0.0, 0.0}, .slab = {.near_mm = -2.0}, .tools = &rays});
  ASSERT_TRUE(picture.tools.has_value());
  const std::size_t middle = 8 + 17 * 8;
  EXPECT_EQ(picture.volume.pixels[middle], 0.0f);  // hidden behind the tool
  EXPECT_EQ(picture.tools->covered[middle], 1);
  EXPECT_EQ(picture.tools->covered[0], 0);
  // Facing the eye: its full colour, times beta = z = 1/2 + 9 / (2 R).
  const double z = 0.5 + 0.5 * 9.0 / camera.sphere.radius_mm;
  EXPECT_NEAR(picture.tools->colors[middle].x, 0.5 * z, 1e-6);
  EXPECT_NEAR(picture.tools->colors[middle].z, 1.0 * z, 1e-6);
}

TEST(ExactPicture, AToolOutOfViewLeavesNoLayer) {
  const Volume volume = ball();
  const ExactWalk walk(volume, kUnit);
  const std::vector<Tool> tools{screen(-50.0, 100.0)};  // behind the eye
  const ToolRays rays(tools);
  const Camera camera = camera_of(volume, {.size = {5, 5}, .field_of_view_rad = 60 * kDegree});
  const Picture picture = exact_picture(walk, camera, {.tools = &rays});
  EXPECT_FALSE(picture.tools.has_value());
  EXPECT_EQ(picture.volume.pixels, exact_picture(walk, camera).volume.pixels);
}

TEST(ExactPicture, IsTheSameForAnyNumberOfThreads) {
  const Volume volume = random_volume<std::int16_t>({40, 30, 20}, -100, 100);
  const EmissionMap map = EmissionMap::window(0.0, 100.0);
  const std::vector<Tool> tools{screen(12.0, 9.0)};
  const auto picture = [&](std::size_t threads, PictureMode mode) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const ExactWalk walk(volume, map);
    const ToolRays rays(tools);
    return exact_picture(walk, camera_of(volume, {.size = {65, 43}}),
                         {.mode = mode,
                          .cue = {0.5, 0.5, 0.0},
                          .levels = {{20.0, 0.3}, {70.0, 0.9}},
                          .tools = &rays});
  };
  for (const PictureMode mode :
       {PictureMode::Max, PictureMode::Sum, PictureMode::Count, PictureMode::Iso}) {
    const Picture one = picture(1, mode);
    const Picture four = picture(4, mode);
    EXPECT_EQ(one.volume.pixels, four.volume.pixels);
    EXPECT_EQ(one.tools->colors, four.tools->colors);
  }
}

TEST(ExactPicture, RefusesBadCuesSlabsAndMissingLevels) {
  const Volume volume = random_volume<float>({2, 2, 2}, 0.0, 1.0);
  const ExactWalk walk(volume, kUnit);
  const Camera camera = camera_of(volume, {.size = {2, 2}});
  EXPECT_THROW(exact_picture(walk, camera, {.mode = PictureMode::Count}), Error);
  EXPECT_THROW(exact_picture(walk, camera, {.mode = PictureMode::Iso}), Error);
  EXPECT_THROW(ideal_picture(walk, camera, {}), Error);
  EXPECT_THROW(exact_picture(walk, camera, {.cue = {-1.0, 0.5, 0.0}}), Error);
  EXPECT_THROW(exact_picture(walk, camera, {.slab = {.near_mm = 2, .far_mm = 1}}), Error);
}

}  // namespace
}  // namespace nacre

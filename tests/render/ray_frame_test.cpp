#include "render/ray_frame.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <optional>

namespace nacre {
namespace {

constexpr double kRounding = 1e-9;
const BoundingSphere kSphere{{10.0, -20.0, 30.0}, 50.0};
const glm::dvec3 kOrigin(7.0, 8.0, 9.0);
const PixelRect kRect{5, 7, 20, 11};
const DepthCue kCue{.a = 0.6, .b = 0.2, .beta0 = 0.1};

Camera camera(std::optional<double> field_of_view_rad) {
  return make_camera({.size = {64, 48},
                      .azimuth_rad = 0.6,
                      .elevation_rad = -0.3,
                      .roll_rad = 0.2,
                      .field_of_view_rad = field_of_view_rad},
                     kSphere);
}

// At a point of a ray, `t_mm` from where it starts, all that a fragment knows is that of the point.
TEST(RayFrame, KnowsAPointOfARay) {
  for (const std::optional<double> field_of_view : {std::optional<double>(), {0.7}, {2.4}}) {
    const Camera eye = camera(field_of_view);
    const Ray ray = picture_ray(eye, kRect.x + 3.5, kRect.y + 4.5);
    const double start = field_of_view ? 20.0 : -30.0;
    const RayFrame frame = ray_frame(eye, kOrigin, {start, 60.0}, kCue, kRect);
    const double forward = glm::dot(ray.direction, eye.forward);
    for (const double t_mm : {0.0, 13.0, 50.0}) {
      const glm::dvec3 p = ray.origin_mm + ((start / forward) + t_mm) * ray.direction;
      const double d = glm::dot(frame.depth_from_local, glm::dvec4(p - kOrigin, 1.0));
      EXPECT_NEAR(d, t_mm * forward, kRounding);
      EXPECT_NEAR(frame.z_of_depth.x + frame.z_of_depth.y * d, depth_z(eye, p), kRounding);
      EXPECT_NEAR(frame.cue.x + frame.cue.y * d, beta(kCue, depth_z(eye, p)), kRounding);
    }
    const glm::dvec2 slope =
        glm::dvec2(frame.slope_of_pixel) +
        glm::dvec2(frame.slope_of_pixel.z, frame.slope_of_pixel.w) * glm::dvec2(3.5, 4.5);
    const glm::dvec3 way = frame.local_from_view * glm::dvec3(slope, 1.0);
    EXPECT_NEAR(glm::length(glm::normalize(way) - ray.direction), 0.0, kRounding);
    EXPECT_NEAR(frame.end_mm, 60.0 - start, kRounding);
  }
}

TEST(RayFrame, BoundsTheCueByItsEnds) {
  const RayFrame frame = ray_frame(camera({}), kOrigin, {}, {.a = -0.5, .b = 0.8}, kRect);
  EXPECT_DOUBLE_EQ(frame.cue_range.x, 0.3);
  EXPECT_DOUBLE_EQ(frame.cue_range.y, 0.8);
}

TEST(MayHide, AsksForOverlapInThePictureAndInDepth) {
  for (const std::optional<double> field_of_view : {std::optional<double>(), {0.7}}) {
    const Camera eye = camera(field_of_view);
    const auto box_at = [&](double right, double forward) {
      const glm::dvec3 at = kSphere.center_mm + right * eye.right + forward * eye.forward - kOrigin;
      return Box{at - 1.0, at + 1.0};
    };
    EXPECT_TRUE(may_hide(eye, kOrigin, box_at(0, -20), box_at(0, 20)));
    EXPECT_FALSE(may_hide(eye, kOrigin, box_at(0, 20), box_at(0, -20)));
    EXPECT_FALSE(may_hide(eye, kOrigin, box_at(15, -20), box_at(-15, 20)));
    EXPECT_TRUE(may_hide(eye, kOrigin, box_at(0, 0), box_at(0, 0)));
  }
}

}  // namespace
}  // namespace nacre

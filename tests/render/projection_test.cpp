#include "render/projection.h"

#include <gtest/gtest.h>

#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "render/tiles.h"

namespace nacre {
namespace {

constexpr double kRounding = 1e-9;
const BoundingSphere kSphere{{10.0, -20.0, 30.0}, 50.0};
const glm::dvec3 kOrigin(7.0, 8.0, 9.0);  // not the sphere's centre

std::vector<Camera> cameras() {
  std::vector<Camera> list;
  for (const std::optional<double> field_of_view : {std::optional<double>(), {0.7}, {2.4}}) {
    list.push_back(make_camera({.size = {64, 48},
                                .azimuth_rad = 0.6,
                                .elevation_rad = -0.3,
                                .roll_rad = 0.2,
                                .zoom = 1.7,
                                .field_of_view_rad = field_of_view,
                                .look_at_mm = glm::dvec3(12, -22, 33)},
                               kSphere));
  }
  return list;
}

glm::dvec4 project(const Camera& camera, const PixelRect& rect, const glm::dvec3& p_mm) {
  return clip_from_local(camera, kOrigin, rect) * glm::dvec4(p_mm - kOrigin, 1.0);
}

// The point of a ray lands, in the target of any rectangle, where the ray went through the picture.
TEST(Projection, PutsARaysPointsOnItsPixel) {
  const std::vector<PixelRect> rects{{0, 0, 64, 48}, {10, 20, 30, 17}};
  for (const Camera& camera : cameras()) {
    for (const PixelRect& rect : rects) {
      for (const double t_mm : {20.0, 90.0}) {
        const Ray ray = picture_ray(camera, 13.5, 40.5);
        const glm::dvec4 clip = project(camera, rect, ray.origin_mm + t_mm * ray.direction);
        EXPECT_NEAR((clip.x / clip.w + 1.0) * 0.5 * rect.width, 13.5 - rect.x, kRounding);
        // Rows are counted from the top, and the target's first row is the top one.
        EXPECT_NEAR((clip.y / clip.w + 1.0) * 0.5 * rect.height, 40.5 - rect.y, kRounding);
      }
    }
  }
}

TEST(Projection, DepthIsThatOfTheSphereWithoutPerspective) {
  const Camera camera = cameras()[0];
  const PixelRect rect{0, 0, 64, 48};
  for (const glm::dvec3& p : {glm::dvec3(0.0), glm::dvec3(40, 10, -5)}) {
    const glm::dvec4 clip = project(camera, rect, p);
    EXPECT_NEAR(clip.z / clip.w, 1.0 - 2.0 * depth_z(camera, p), kRounding);
  }
}

TEST(Projection, NearPlaneIsTheOnlyOneInPerspective) {
  const Camera camera = cameras()[1];
  const PixelRect rect{0, 0, 64, 48};
  const double near_mm = near_plane_mm(camera);
  const auto z = [&](double eye_depth_mm) {
    const glm::dvec4 clip = project(camera, rect, eye_mm(camera) + eye_depth_mm * camera.forward);
    return clip.z / clip.w;
  };
  EXPECT_NEAR(z(near_mm), -1.0, 1e-6);
  EXPECT_LT(z(0.5 * near_mm), -1.0);
  EXPECT_LT(z(1e9), 1.0);
}

Box box_at(const glm::dvec3& p_mm, double half_side = 1.0) {
  return {p_mm - kOrigin - half_side, p_mm - kOrigin + half_side};
}

TEST(Projection, SeesABoxOnAnyRayOfThePicture) {
  for (const Camera& camera : cameras()) {
    for (const double x : {0.0, 30.0, 64.0}) {
      for (const double y : {0.0, 20.0, 48.0}) {
        const Ray ray = picture_ray(camera, x, y);
        const Box box = box_at(ray.origin_mm + 60.0 * ray.direction, 1e-3);
        EXPECT_FALSE(outside_view(camera, kOrigin, box));
      }
    }
  }
}

TEST(Projection, SeesNoBoxBesideThePicture) {
  for (const Camera& camera : cameras()) {
    for (const glm::dvec2& pixel :
         {glm::dvec2(-10, 20), glm::dvec2(74, 20), glm::dvec2(30, -10), glm::dvec2(30, 58)}) {
      const Ray ray = picture_ray(camera, pixel.x, pixel.y);
      const Box box = box_at(ray.origin_mm + 60.0 * ray.direction, 0.1);
      EXPECT_TRUE(outside_view(camera, kOrigin, box)) << pixel.x << ", " << pixel.y;
    }
  }
}

TEST(Projection, SeesNoBoxBehindAPerspectiveEye) {
  for (const Camera& camera : cameras()) {
    const glm::dvec3 from = camera.perspective ? eye_mm(camera) : camera.target_mm;
    const Box box = box_at(from - 40.0 * camera.forward);
    EXPECT_EQ(outside_view(camera, kOrigin, box), camera.perspective);
    const Box around_the_eye = box_at(from);
    EXPECT_FALSE(outside_view(camera, kOrigin, around_the_eye));
  }
}

TEST(Tiles, CoverThePictureOnce) {
  for (const glm::ivec2& size : {glm::ivec2(1, 1), glm::ivec2(100, 37), glm::ivec2(64, 64)}) {
    std::vector<int> covered(std::size_t(size.x) * std::size_t(size.y));
    for (const PixelRect& rect : tiles(size, 32)) {
      EXPECT_LE(rect.width, 32);
      EXPECT_LE(rect.height, 32);
      for (int y = rect.y; y < rect.y + rect.height; ++y) {
        for (int x = rect.x; x < rect.x + rect.width; ++x) {
          ++covered[std::size_t(x) + std::size_t(size.x) * std::size_t(y)];
        }
      }
    }
    EXPECT_EQ(covered, std::vector<int>(covered.size(), 1));
  }
}

}  // namespace
}  // namespace nacre

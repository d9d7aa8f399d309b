#include "core/volume_silhouette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <random>
#include <vector>

#include "core/volume_geometry.h"

namespace nacre {
namespace {

struct Box {
  glm::i64vec3 dims;
  glm::dmat4 world_from_voxel;
};

/// Upright, oblique, sheared and uneven boxes, one of a single sample, far from the origin or not.
std::vector<Box> boxes() {
  const glm::dmat4 turned =
      glm::rotate(glm::translate(glm::dmat4(1.0), {1e4, -300.0, 7.0}), 0.3, glm::dvec3(1, 2, 3));
  glm::dmat4 sheared(1.0);
  sheared[1] = {0.7, 1.0, 0.0, 0.0};
  sheared[2] = {-0.2, 0.4, 2.0, 0.0};
  return {{{9, 7, 5}, glm::dmat4(1.0)},
          {{9, 7, 5}, turned},
          {{30, 4, 11}, turned * glm::scale(glm::dmat4(1.0), {0.4, 1.3, -2.0})},
          {{6, 9, 4}, sheared},
          {{1, 1, 1}, turned},
          {{40, 1, 3}, turned * sheared}};
}

/// Orthographic and perspective ones from all sides, zoomed, aside, near, and from within.
std::vector<Camera> cameras(const BoundingSphere& sphere) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Camera> cameras;
  for (int i = 0; i < 60; ++i) {
    CameraOptions options;
    options.size = i % 3 == 0 ? glm::ivec2(41, 30) : glm::ivec2(33, 37);
    options.azimuth_rad = 7.0 * unit(random);
    options.elevation_rad = 3.0 * unit(random) - 1.5;
    options.roll_rad = unit(random);
    options.zoom = i % 4 == 0 ? 3.0 : 0.8;
    if (i % 2 == 1) {
      options.field_of_view_rad = 0.3 + 1.5 * unit(random);
      // From within the box to far away.
      if (i % 6 != 1) options.distance_mm = sphere.radius_mm * 1.5 * unit(random);
    }
    const glm::dvec3 aside(unit(random), unit(random), unit(random));
    options.look_at_mm = sphere.center_mm + 0.4 * sphere.radius_mm * (aside - 0.5);
    cameras.push_back(make_camera(options, sphere));
  }
  return cameras;
}

/// Whether a ray meets a box that is larger by so many voxels to each side, plane by plane.
bool meets(const Camera& camera, const Box& box, int x, int y, double larger) {
  Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
  const VoxelBox voxels = voxel_box(box.dims);
  const glm::dmat4 from_local = voxel_from_local(box.dims, box.world_from_voxel);
  const glm::dvec3 center_mm = bounding_sphere(box.dims, box.world_from_voxel).center_mm;
  const glm::dvec3 origin(from_local * glm::dvec4(ray.origin_mm - center_mm, 1.0));
  const glm::dvec3 direction(from_local * glm::dvec4(ray.direction, 0.0));
  double first = camera.perspective ? 0.0 : -std::numeric_limits<double>::infinity();
  double last = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (voxels.lo[axis] - larger - origin[axis]) / direction[axis];
    const double b = (voxels.hi[axis] + larger - origin[axis]) / direction[axis];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first < last;
}

TEST(VolumeSilhouette, HoldsThePixelsWhoseRaysMeetTheBox) {
  constexpr double kTie = 1e-6;
  int within = 0;
  int beyond = 0;
  for (const Box& box : boxes()) {
    for (const Camera& camera : cameras(bounding_sphere(box.dims, box.world_from_voxel))) {
      const auto spans = volume_silhouette(camera, box.dims, box.world_from_voxel);
      ASSERT_EQ(spans.size(), static_cast<std::size_t>(camera.size.y));
      for (int y = 0; y < camera.size.y; ++y) {
        const PixelSpan& span = spans[static_cast<std::size_t>(y)];
        ASSERT_TRUE(0 <= span.first && span.first <= span.end && span.end <= camera.size.x);
        for (int x = 0; x < camera.size.x; ++x) {
          const bool held = x >= span.first && x < span.end;
          if (meets(camera, box, x, y, -kTie)) {
            ASSERT_TRUE(held) << x << ", " << y;
            ++within;
          } else if (!meets(camera, box, x, y, kTie)) {
            ASSERT_FALSE(held) << x << ", " << y;
            ++beyond;
          }
        }
      }
    }
  }
  EXPECT_GT(within, 50'000);
  EXPECT_GT(beyond, 50'000);
}

TEST(VolumeSilhouette, IsTheWholePictureFromWithinAndNothingBehindTheEye) {
  const glm::i64vec3 dims(9, 9, 9);
  CameraOptions options{.size = {20, 10}, .field_of_view_rad = 1.0, .distance_mm = 0.0};
  const BoundingSphere sphere = bounding_sphere(dims, glm::dmat4(1.0));
  for (const PixelSpan& span :
       volume_silhouette(make_camera(options, sphere), dims, glm::dmat4(1.0))) {
    EXPECT_EQ(span.first, 0);
    EXPECT_EQ(span.end, 20);
  }
  options.look_at_mm = sphere.center_mm + glm::dvec3(0.0, 30.0, 0.0);  // anterior: looks along +y
  for (const PixelSpan& span :
       volume_silhouette(make_camera(options, sphere), dims, glm::dmat4(1.0))) {
    EXPECT_EQ(span.first, span.end);
  }
}

TEST(VolumeSilhouette, BlacksWhatIsOutside) {
  Image picture = make_image(4, 3);
  std::fill(picture.pixels.begin(), picture.pixels.end(), 1.0F);
  const Image whole = picture;
  black_outside({}, picture);
  EXPECT_EQ(picture.pixels, whole.pixels);
  const std::vector<PixelSpan> spans{{0, 4}, {1, 3}, {0, 0}};
  black_outside(spans, picture);
  EXPECT_EQ(picture.pixels, (std::vector<float>{1, 1, 1, 1, 0, 1, 1, 0, 0, 0, 0, 0}));
}

TEST(VolumeSilhouette, PixelsShowWhereTheirMiddleRaysDo) {
  std::vector<PixelSpan> rays;
  for (int y = 0; y < 21; ++y) rays.push_back({y / 2, 18 - y / 3});
  rays.push_back({7, 7});  // none
  rays.push_back({0, 0});
  rays.push_back({0, 24});
  for (const int per_pixel : {1, 3}) {
    const std::vector<PixelSpan> pixels = middle_spans(rays, per_pixel);
    ASSERT_EQ(pixels.size(), rays.size() / static_cast<std::size_t>(per_pixel));
    for (std::size_t y = 0; y < pixels.size(); ++y) {
      const PixelSpan& span =
          rays[y * static_cast<std::size_t>(per_pixel) + static_cast<std::size_t>(per_pixel / 2)];
      for (int x = 0; x < 24 / per_pixel; ++x) {
        const int middle = x * per_pixel + per_pixel / 2;
        EXPECT_EQ(x >= pixels[y].first && x < pixels[y].end,
                  middle >= span.first && middle < span.end)
            << per_pixel << ' ' << y << ' ' << x;
      }
    }
  }
  EXPECT_TRUE(middle_spans({}, 3).empty());
}

}  // namespace
}  // namespace nacre

#include "core/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/error.h"

namespace nacre {
namespace {

constexpr double kRounding = 1e-12;
constexpr double kDegree = std::numbers::pi / 180.0;
const BoundingSphere kSphere{{10.0, 20.0, 30.0}, 50.0};

const glm::dvec3 kLeft(1, 0, 0);
const glm::dvec3 kPosterior(0, 1, 0);
const glm::dvec3 kSuperior(0, 0, 1);

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = kRounding) {
  EXPECT_LE(glm::length(a - b), tolerance) << "(" << a.x << ", " << a.y << ", " << a.z << ") and ("
                                           << b.x << ", " << b.y << ", " << b.z << ")";
}

TEST(Camera, NamedViewsShowThePatientAsRadiologyDoes) {
  const Camera anterior = make_camera({.view = NamedView::Anterior}, kSphere);
  expect_near(anterior.forward, kPosterior);
  expect_near(anterior.up, kSuperior);
  expect_near(anterior.right, kLeft);  // the patient's left on the picture's right

  const Camera posterior = make_camera({.view = NamedView::Posterior}, kSphere);
  expect_near(posterior.forward, -kPosterior);
  expect_near(posterior.right, -kLeft);

  const Camera left = make_camera({.view = NamedView::Left}, kSphere);
  expect_near(left.forward, -kLeft);
  expect_near(left.right, kPosterior);

  const Camera right = make_camera({.view = NamedView::Right}, kSphere);
  expect_near(right.forward, kLeft);
  expect_near(right.right, -kPosterior);

  const Camera superior = make_camera({.view = NamedView::Superior}, kSphere);
  expect_near(superior.forward, -kSuperior);
  expect_near(superior.up, -kPosterior);
  expect_near(superior.right, -kLeft);

  const Camera inferior = make_camera({.view = NamedView::Inferior}, kSphere);
  expect_near(inferior.forward, kSuperior);
  expect_near(inferior.up, -kPosterior);
  expect_near(inferior.right, kLeft);
}

TEST(Camera, NamesAreRoundTrips) {
  for (const char* wanted : {"anterior", "posterior", "left", "right", "superior", "inferior"}) {
    ASSERT_TRUE(named_view(wanted).has_value());
    EXPECT_EQ(name(*named_view(wanted)), wanted);
  }
  EXPECT_FALSE(named_view("front").has_value());
}

TEST(Camera, AzimuthMovesToTheRightAndElevationUp) {
  // From the front, a quarter turn to the camera's right stands at the patient's left.
  const Camera side = make_camera({.azimuth_rad = 90 * kDegree}, kSphere);
  expect_near(side.forward, -kLeft, 0.0);
  const Camera above = make_camera({.elevation_rad = 30 * kDegree}, kSphere);
  expect_near(above.forward, {0, std::cos(30 * kDegree), -std::sin(30 * kDegree)});
  expect_near(above.up, {0, std::sin(30 * kDegree), std::cos(30 * kDegree)});
}

// vtkCamera keeps its view-up vector: over the pole the picture stands on its head.
TEST(Camera, KeepsTheViewUpVectorBeyondThePole) {
  const Camera beyond = make_camera({.elevation_rad = 120 * kDegree}, kSphere);
  EXPECT_GT(glm::dot(beyond.up, kSuperior), 0.0);
  const Camera at_pole = make_camera({.elevation_rad = 90 * kDegree}, kSphere);
  expect_near(at_pole.forward, -kSuperior);
  expect_near(at_pole.up, kPosterior);
  expect_near(at_pole.right, kLeft);
}

// Right-handed about the viewing direction, as vtkCamera::Roll: up turns towards the right.
TEST(Camera, RollTurnsUpTowardsTheRight) {
  const Camera rolled = make_camera({.roll_rad = 90 * kDegree}, kSphere);
  expect_near(rolled.up, kLeft);
  expect_near(rolled.right, -kSuperior);
}

TEST(Camera, StaysRightHandedAndOrthonormal) {
  for (int azimuth = -180; azimuth <= 180; azimuth += 45) {
    for (int elevation = -90; elevation <= 90; elevation += 30) {
      const Camera camera = make_camera({.view = NamedView::Superior,
                                         .azimuth_rad = azimuth * kDegree,
                                         .elevation_rad = elevation * kDegree,
                                         .roll_rad = 25 * kDegree},
                                        kSphere);
      expect_near(glm::cross(camera.forward, camera.up), camera.right);
      EXPECT_NEAR(glm::length(camera.up), 1.0, kRounding);
      EXPECT_NEAR(glm::dot(camera.up, camera.forward), 0.0, kRounding);
    }
  }
}

TEST(Camera, OrthographicPictureSpansTheSphereOnItsShorterSide) {
  const Camera camera = make_camera({.size = {200, 100}, .zoom = 2.0}, kSphere);
  // Upper edge, middle: R / zoom above the centre.
  const Ray top = picture_ray(camera, 100.0, 0.0);
  expect_near(top.origin_mm, kSphere.center_mm + 25.0 * kSuperior);
  const Ray side = picture_ray(camera, 200.0, 50.0);
  expect_near(side.origin_mm, kSphere.center_mm + 50.0 * kLeft);
  expect_near(side.direction, kPosterior);
}

TEST(Camera, PerspectiveTouchesTheSphere) {
  const Camera camera = make_camera({.field_of_view_rad = 40 * kDegree}, kSphere);
  const Ray top = picture_ray(camera, 256.0, 0.0);
  // The ray through the middle of the upper edge is tangent to the bounding sphere.
  const glm::dvec3 to_center = kSphere.center_mm - top.origin_mm;
  EXPECT_NEAR(glm::length(glm::cross(top.direction, to_center)), kSphere.radius_mm, 1e-10);
  EXPECT_NEAR(glm::length(to_center), kSphere.radius_mm / std::sin(20 * kDegree), 1e-10);
}

TEST(Camera, ZoomNarrowsThePictureAndLeavesTheEye) {
  const Camera near = make_camera({.zoom = 4.0, .field_of_view_rad = 40 * kDegree}, kSphere);
  const Camera far = make_camera({.field_of_view_rad = 40 * kDegree}, kSphere);
  expect_near(eye_mm(near), eye_mm(far));
  EXPECT_NEAR(near.half_extent, far.half_extent / 4.0, kRounding);
}

TEST(Camera, DistanceAndTargetPlaceTheEye) {
  const Camera camera = make_camera(
      {.field_of_view_rad = 40 * kDegree, .distance_mm = 5.0, .look_at_mm = glm::dvec3(1, 2, 3)},
      kSphere);
  expect_near(eye_mm(camera), {1, -3, 3});
}

TEST(Camera, DepthIsOneAtTheNearestPointOfTheSphere) {
  const Camera camera = make_camera({.look_at_mm = glm::dvec3(1, 2, 3)}, kSphere);
  EXPECT_NEAR(depth_z(camera, kSphere.center_mm - 50.0 * kPosterior), 1.0, kRounding);
  EXPECT_NEAR(depth_z(camera, kSphere.center_mm + 50.0 * kPosterior), 0.0, kRounding);
  EXPECT_NEAR(slab_depth_mm(camera, kSphere.center_mm + 7.0 * kPosterior), 7.0, kRounding);
  // Orthographic rays start in the plane through the sphere's centre, wherever the target is.
  const Ray ray = picture_ray(camera, 3.0, 5.0);
  EXPECT_NEAR(slab_depth_mm(camera, ray.origin_mm), 0.0, kRounding);
}

TEST(Camera, RefusesWhatIsOutOfRange) {
  EXPECT_THROW(make_camera({.size = {0, 5}}, kSphere), Error);
  EXPECT_THROW(make_camera({.size = {5, 40000}}, kSphere), Error);
  EXPECT_THROW(make_camera({.zoom = 0.0}, kSphere), Error);
  EXPECT_THROW(make_camera({.azimuth_rad = std::nan("")}, kSphere), Error);
  EXPECT_THROW(make_camera({.field_of_view_rad = 180 * kDegree}, kSphere), Error);
  EXPECT_THROW(make_camera({.distance_mm = 5.0}, kSphere), Error);
  EXPECT_THROW(make_camera({.look_at_mm = glm::dvec3(0, std::nan(""), 0)}, kSphere), Error);
}

}  // namespace
}  // namespace nacre

// Fields whose pictures are known in closed form, cut into shells by the midpoint rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "tests/render/gl_test_support.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {
namespace {

const glm::dvec3 kCenter(20.0, -30.0, 40.0);
const BoundingSphere kSphere{kCenter, 60.0};
constexpr double kRadius = 50.0;  // of the support of the field 1 - |p| / kRadius

const DepthCue kCue{.a = 0.6, .b = 0.3, .beta0 = 0.1};

double volume_of(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    sum += glm::dot(glm::dvec3(mesh.positions[t.x]),
                    glm::cross(glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])));
  }
  return sum / 6.0;
}

/// A ball whose mesh holds as much as the ball: what is inscribed would be too small.
TriangleMesh full_ball(double radius) {
  constexpr int rings = 32;
  static const double grow =
      std::cbrt(4.0 / 3.0 * std::numbers::pi / volume_of(ball_mesh({}, 1.0, rings)));
  return ball_mesh({}, radius * grow, rings);
}

/// Shells of the field 1 - |p| / kRadius: t_k = (k - 1/2) / N, r_k = k / N.
ShellSet cone_of_spheres(int levels) {
  std::vector<TriangleMesh> surfaces;
  for (int k = 1; k <= levels; ++k) {
    surfaces.push_back(full_ball(kRadius * (1.0 - (k - 0.5) / levels)));
  }
  return make_set(std::move(surfaces), kCenter);
}

/// A wall across the viewing direction, `depth_mm` behind the centre.
Tool wall(const Camera& camera, double depth_mm) {
  Tool tool;
  const glm::dvec3 at = kCenter + depth_mm * camera.forward;
  const auto corner = [&](double x, double y) {
    return glm::vec3(at + 500.0 * (x * camera.right + y * camera.up));
  };
  tool.mesh = {{corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)},
               {{0, 1, 2}, {0, 2, 3}}};
  return tool;
}

/// A ray by its nearest point to the centre: distance there, and the cue as a line about it.
struct NearestPoint {
  double distance_mm;
  double cue;         ///< beta at it
  double cue_per_mm;  ///< along the ray
  double end_mm;      ///< of the ray, from it
};

NearestPoint nearest_point(const Camera& camera, int x, int y, const DepthCue& cue,
                           double wall_mm) {
  const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
  const double t = glm::dot(kCenter - ray.origin_mm, ray.direction);
  const glm::dvec3 p = ray.origin_mm + t * ray.direction;
  const double forward = glm::dot(ray.direction, camera.forward);
  return {glm::length(p - kCenter), beta(cue, depth_z(camera, p)),
          -cue.a * forward / (2.0 * kSphere.radius_mm),
          (wall_mm - slab_depth_mm(camera, p)) / forward};
}

/// The integral of beta (1 - |p| / R) along the ray, to its end.
double exact_sum(const NearestPoint& ray) {
  const double d = ray.distance_mm;
  if (d >= kRadius) return 0.0;
  const double half = std::sqrt(kRadius * kRadius - d * d);
  const auto antiderivative = [&](double s) {
    const double q = std::sqrt(d * d + s * s);
    const double even = s - (s * q + d * d * std::asinh(s / d)) / (2.0 * kRadius);
    const double odd = 0.5 * s * s - q * q * q / (3.0 * kRadius);
    return ray.cue * even + ray.cue_per_mm * odd;
  };
  const double end = std::min(half, ray.end_mm);
  return end > -half ? antiderivative(end) - antiderivative(-half) : 0.0;
}

struct SumError {
  double rms = 0.0;       ///< over all pixels, of the largest exact one
  double greatest = 0.0;  ///< the same
  double flux = 0.0;      ///< of all pixels together, relative
};

constexpr double kNoWall = 1e6;

class GlClosedForms : public GlTest {
 protected:
  static SumError sum_error(const ShellSet& set, const Camera& camera, const DepthCue& cue,
                            double wall_mm = kNoWall) {
    const std::vector<Tool> tools{wall(camera, wall_mm)};
    const std::size_t count = wall_mm == kNoWall ? 0 : 1;
    const Image image = draw_with(std::span(tools).first(count), set, camera,
                                  {.mode = PictureMode::Sum, .cue = cue})
                            .volume;
    double largest = 0.0;
    double squares = 0.0;
    double shown = 0.0;
    double exact = 0.0;
    SumError error;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const double truth = exact_sum(nearest_point(camera, x, y, cue, wall_mm));
        const double difference = image.at(x, y) - truth;
        largest = std::max(largest, truth);
        squares += difference * difference;
        error.greatest = std::max(error.greatest, std::abs(difference));
        shown += image.at(x, y);
        exact += truth;
      }
    }
    error.rms = std::sqrt(squares / static_cast<double>(image.pixels.size())) / largest;
    error.greatest /= largest;
    error.flux = std::abs(shown - exact) / exact;
    return error;
  }
};

CameraOptions view(std::optional<double> field_of_view_rad = std::nullopt) {
  return {.size = {64, 64},
          .azimuth_rad = 0.37,
          .elevation_rad = 0.21,
          .field_of_view_rad = field_of_view_rad};
}

TEST_F(GlClosedForms, SumsOf32LevelsAreWithinAHalfPercent) {
  const ShellSet set = cone_of_spheres(32);
  for (const std::optional<double> field_of_view : {std::optional<double>(), {0.8}}) {
    const Camera camera = make_camera(view(field_of_view), kSphere);
    for (const DepthCue& cue : {DepthCue{}, kCue}) {
      for (const double wall_mm : {kNoWall, -15.0, 12.0}) {
        SCOPED_TRACE(::testing::Message() << (field_of_view ? "perspective" : "orthographic")
                                          << ", a = " << cue.a << ", wall at " << wall_mm);
        const SumError error = sum_error(set, camera, cue, wall_mm);
        EXPECT_LT(error.rms, 0.005);
        EXPECT_LT(error.greatest, 0.01);
      }
    }
  }
}

// A chord ends like a square root: order 3/2 in the layer's width. Over all pixels the ends average
// out: order 2.
TEST_F(GlClosedForms, SumsConvergeAsDerived) {
  const Camera camera = make_camera(view(), kSphere);
  for (const DepthCue& cue : {DepthCue{}, kCue}) {
    const SumError coarse = sum_error(cone_of_spheres(4), camera, cue);
    const SumError fine = sum_error(cone_of_spheres(16), camera, cue);
    EXPECT_NEAR(std::log2(coarse.rms / fine.rms) / 2.0, 1.5, 0.2);
    EXPECT_NEAR(std::log2(coarse.flux / fine.flux) / 2.0, 2.0, 0.2);
  }
}

// Away from silhouettes a layer's maximum is its representative, times the cue at its front.
TEST_F(GlClosedForms, MaximumOfSpheresIsThatOfItsLayers) {
  constexpr int levels = 8;
  const ShellSet set = cone_of_spheres(levels);
  for (const std::optional<double> field_of_view : {std::optional<double>(), {0.8}}) {
    const Camera camera = make_camera(view(field_of_view), kSphere);
    for (const double wall_mm : {kNoWall, -15.0, 12.0}) {
      const std::vector<Tool> tools{wall(camera, wall_mm)};
      for (const Occlusion occlusion : {Occlusion::Passes, Occlusion::Texture}) {
        const Image image = draw_with(tools, set, camera, {.occlusion = occlusion}).volume;
        for (int y = 0; y < image.height; y += 3) {
          for (int x = 0; x < image.width; x += 3) {
            const NearestPoint ray = nearest_point(camera, x, y, {}, wall_mm);
            const double along = std::min(0.0, ray.end_mm);
            const double nearest = std::hypot(ray.distance_mm, along);
            const double layer = levels * (1.0 - nearest / kRadius) + 0.5;
            if (std::abs(layer - std::round(layer)) < 0.03) continue;  // a mesh is no sphere
            const double rank = std::clamp(std::floor(layer), 0.0, double(levels));
            ASSERT_EQ(image.at(x, y), static_cast<float>(rank / levels))
                << x << ", " << y << ", wall at " << wall_mm;
          }
        }
      }
    }
  }
}

/// A slab of constant emission 1, from -20 to 30 mm along the viewing direction, seen straight on.
class GlConstantSlab : public GlTest {
 protected:
  static Image draw_slab(const Camera& camera, const RenderOptions& options, double wall_mm) {
    ShellSet set = make_set({block_mesh({-45, -20, -45}, {45, 30, 45})}, kCenter);
    const std::vector<Tool> tools{wall(camera, wall_mm)};
    return draw_with(tools, set, camera, options).volume;
  }

  /// beta at a depth behind the centre.
  static double cue_at(const DepthCue& cue, double depth_mm) {
    return beta(cue, 0.5 - depth_mm / (2.0 * kSphere.radius_mm));
  }
};

constexpr std::array<double, 5> kWalls{-35.0, -20.0 + 1e-3, 5.0, 29.0, kNoWall};

TEST_F(GlConstantSlab, SumIsItsLengthTimesTheMeanCue) {
  for (const std::optional<double> field_of_view : {std::optional<double>(), {0.5}}) {
    const Camera camera =
        make_camera({.size = {9, 9}, .zoom = 4.0, .field_of_view_rad = field_of_view}, kSphere);
    for (const DepthCue& cue : {DepthCue{}, kCue, DepthCue{.a = -0.5, .b = 0.8}}) {
      for (const double wall_mm : kWalls) {
        const Image image = draw_slab(camera, {.mode = PictureMode::Sum, .cue = cue}, wall_mm);
        const double end = std::clamp(wall_mm, -20.0, 30.0);
        const double mean = 0.5 * (cue_at(cue, -20.0) + cue_at(cue, end));
        const double forward = glm::dot(picture_ray(camera, 0.5, 0.5).direction, camera.forward);
        EXPECT_NEAR(image.at(4, 4), (end + 20.0) * mean, 2e-4) << wall_mm;
        EXPECT_NEAR(image.at(0, 0), (end + 20.0) * mean / forward, 2e-4) << wall_mm;
      }
    }
  }
}

TEST_F(GlConstantSlab, MaximumIsTheCueWhereItIsBrightest) {
  for (const std::optional<double> field_of_view : {std::optional<double>(), {0.5}}) {
    const Camera camera =
        make_camera({.size = {9, 9}, .zoom = 4.0, .field_of_view_rad = field_of_view}, kSphere);
    for (const DepthCue& cue : {DepthCue{}, kCue, DepthCue{.a = -0.5, .b = 0.8}}) {
      for (const double wall_mm : kWalls) {
        for (const Occlusion occlusion : {Occlusion::Passes, Occlusion::Texture}) {
          const Image image = draw_slab(camera, {.cue = cue, .occlusion = occlusion}, wall_mm);
          const double brightest = cue.a < 0.0 ? std::min(wall_mm, 30.0) : -20.0;
          const double truth = wall_mm < -20.0 ? 0.0 : cue_at(cue, brightest);
          EXPECT_NEAR(image.at(4, 4), truth, 1e-6) << wall_mm;
          EXPECT_NEAR(image.at(0, 8), truth, 1e-6) << wall_mm;
        }
      }
    }
  }
}

TEST_F(GlConstantSlab, CountAndIsoSeeTheirCrossings) {
  const Camera camera = make_camera({.size = {9, 9}, .zoom = 4.0}, kSphere);
  for (const double wall_mm : kWalls) {
    const double crossings = wall_mm < -20.0 ? 0.0 : wall_mm < 30.0 ? 1.0 : 2.0;
    for (const TargetFormat target : {TargetFormat::F32, TargetFormat::F16, TargetFormat::U8}) {
      const Image count =
          draw_slab(camera, {.mode = PictureMode::Count, .target = target}, wall_mm);
      // Eight bits end at 1, as [H96] had them.
      EXPECT_EQ(count.at(4, 4), target == TargetFormat::U8 ? std::min(crossings, 1.0) : crossings);
    }
    const Image iso = draw_slab(camera, {.mode = PictureMode::Iso, .cue = kCue}, wall_mm);
    EXPECT_EQ(iso.at(4, 4) > 0.0F, wall_mm > -20.0);
  }
}

TEST_F(GlConstantSlab, SumsInHalfFloatsAreAsExactAsStated) {
  const Camera camera = make_camera({.size = {9, 9}, .zoom = 4.0}, kSphere);
  const Image image =
      draw_slab(camera, {.mode = PictureMode::Sum, .target = TargetFormat::F16}, 5.0);
  EXPECT_NEAR(image.at(4, 4), 25.0, 25.0 * 0x1p-11);
}

}  // namespace
}  // namespace nacre::testing

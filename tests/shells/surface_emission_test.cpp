#include "shells/surface_emission.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "shells/field_bounds.h"
#include "tests/support/analytic_surfaces.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::cube_surface;
using testing::random_volume;
using testing::volume_of;

constexpr double kRounding = 1e-9;

/// A point of the triangle, all of them as a and b run over [0, 1] with a + b <= 1.
glm::dvec3 point(const std::array<glm::dvec3, 3>& t, double a, double b) {
  return (1.0 - a - b) * t[0] + a * t[1] + b * t[2];
}

TEST(FieldBounds, HoldEveryPointOfRandomTriangles) {
  const Volume volume = random_volume<std::uint8_t>({7, 6, 5}, 0, 255);
  const TrilinearField field(volume);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1.0, 7.0);  // also outside the box
  for (int i = 0; i < 40; ++i) {
    std::array<glm::dvec3, 3> t;
    for (glm::dvec3& p : t) p = {coordinate(random), coordinate(random), coordinate(random)};
    const ValueBounds bounds = value_bounds(field, t[0], t[1], t[2]);
    for (int a = 0; a <= 20; ++a) {
      for (int b = 0; a + b <= 20; ++b) {
        const double value = field.value(point(t, a / 20.0, b / 20.0));
        ASSERT_GE(value, bounds.lo - kRounding);
        ASSERT_LE(value, bounds.hi + kRounding);
      }
    }
  }
}

// Within a cell they approach the range with the second order of the size.
TEST(FieldBounds, TightenWithTheSquareOfTheSize) {
  const Volume volume = random_volume<std::uint8_t>({2, 2, 2}, 0, 255, 5);
  const TrilinearField field(volume);
  const auto slack = [&](double size) {
    const std::array<glm::dvec3, 3> t{glm::dvec3(0.4),
                                      glm::dvec3(0.4) + size * glm::dvec3(0.5, 0.1, 0.2),
                                      glm::dvec3(0.4) + size * glm::dvec3(0.1, 0.2, 0.6)};
    const ValueBounds bounds = value_bounds(field, t[0], t[1], t[2]);
    double lo = 1e9;
    double hi = -1e9;
    for (int a = 0; a <= 50; ++a) {
      for (int b = 0; a + b <= 50; ++b) {
        const double value = field.value(point(t, a / 50.0, b / 50.0));
        lo = std::min(lo, value);
        hi = std::max(hi, value);
      }
    }
    return std::max(lo - bounds.lo, bounds.hi - hi);
  };
  EXPECT_LE(slack(0.5), 0.3 * slack(1.0) + kRounding);
  EXPECT_LE(slack(0.25), 0.3 * slack(0.5) + kRounding);
}

/// Emission along x: 0 at the first sample, 1 at the last.
Volume ramp() {
  return volume_of<std::uint8_t>({11, 11, 11}, [](auto x, auto, auto) { return 10 * x; });
}

TEST(SurfaceEmission, OfACubeInARampIsWhatItsSidesCut) {
  const Volume volume = ramp();
  const TrilinearField field(volume);
  const EmissionMap emission = EmissionMap::window(0, 100);
  // x from -2 to 2 about the centre: emission from 0.3 to 0.7.
  const SurfaceEmission found =
      measure_surface_emission(cube_surface(2.0F, 3), field, emission, 0.5, 0.1);
  EXPECT_NEAR(found.lo, 0.3, kRounding);
  EXPECT_NEAR(found.hi, 0.7, kRounding);
  EXPECT_NEAR(found.max_error, 0.2, kRounding);
  EXPECT_NEAR(found.error_bound(0.5), 0.2, kRounding);
  // Four sides with errors evenly from 0 to 0.2, two with 0.2: (4 / 3 + 2) 0.04 / 6; the midpoints'
  // rule is a little below.
  EXPECT_NEAR(found.rms_error, std::sqrt(0.04 * (4.0 / 3.0 + 2.0) / 6.0), 2e-3);
  // Half of four sides and all of two.
  EXPECT_NEAR(found.beyond_tolerance, 4.0 / 6.0, 0.05);
}

TEST(SurfaceEmission, OnTheLevelHasNoError) {
  const Volume volume = ramp();
  const TrilinearField field(volume);
  const EmissionMap emission = EmissionMap::window(0, 100);
  const TriangleMesh sheet{{{0, -2, -2}, {0, 2, -2}, {0, 2, 2}, {0, -2, 2}},
                           {{0, 1, 2}, {0, 2, 3}}};
  const SurfaceEmission found = measure_surface_emission(sheet, field, emission, 0.5);
  EXPECT_NEAR(found.max_error, 0.0, kRounding);
  EXPECT_NEAR(found.hi - found.lo, 0.0, kRounding);
}

// A step of the grid accounts for what it can change.
TEST(SurfaceEmission, AllowsForSnapping) {
  const Volume volume = ramp();
  const TrilinearField field(volume);
  const EmissionMap emission = EmissionMap::window(0, 100);
  const TriangleMesh sheet{{{0.2F, -2, -2}, {0.2F, 2, -2}, {0.2F, 2, 2}}, {{0, 1, 2}}};
  const SurfaceEmission found = measure_surface_emission(sheet, field, emission, 0.5, 0.0, 0.15);
  EXPECT_NEAR(found.max_error, 0.02, 1e-7);
  EXPECT_NEAR(found.max_error_less_snapping, 0.005, 1e-7);
}

TEST(SurfaceEmission, CapsDoNotCount) {
  const Volume volume = ramp();
  const TrilinearField field(volume);
  const EmissionMap emission = EmissionMap::window(0, 100);
  // The whole box, capped on all sides.
  const SurfaceEmission found = measure_surface_emission(cube_surface(5.0F), field, emission, 0.25);
  EXPECT_GT(found.lo, found.hi);
  EXPECT_EQ(found.error_bound(0.25), 0.0);
  EXPECT_NEAR(found.max_error, 0.25, kRounding);  // what of the box is below the level
}

}  // namespace
}  // namespace nacre

#include "shells/coarsen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/error.h"
#include "shells/shell_checks.h"
#include "shells/simplify.h"
#include "tests/support/analytic_surfaces.h"
#include "tests/support/dense_error.h"
#include "tests/support/sound_surface.h"
#include "tests/support/sphere_field.h"

namespace nacre {
namespace {

using testing::cube_surface;
using testing::expect_sound;
using testing::sphere_surface;
using testing::torus_surface;

constexpr float kRadius = 10.0f;
constexpr int kDense = 7;  // parts of a triangle's side

double sphere_error(const glm::dvec3& p) { return std::abs(glm::length(p) - double{kRadius}); }

constexpr testing::SphereField sphere_field{double{kRadius}};

/// Distance from the torus of these radii, signed.
FieldSample torus_field(const glm::dvec3& p) {
  const double ring = std::hypot(p.x, p.y);
  const glm::dvec3 center = 20.0 / ring * glm::dvec3(p.x, p.y, 0.0);
  const double r = glm::distance(p, center);
  return {r - 6.0, (p - center) / r};
}

TEST(Coarsen, KeepsTheErrorBound) {
  const TriangleMesh sphere = sphere_surface(kRadius, 20);
  std::size_t before = sphere.triangles.size();
  for (const double tolerance : {0.1, 0.5}) {
    const TriangleMesh coarse = coarsen(sphere, sphere_field, {.error_tolerance = tolerance});
    expect_sound(coarse, 2);
    EXPECT_LE(testing::largest_error(coarse, sphere_error, kDense), tolerance * 1.15)
        << "between the samples";
    EXPECT_LT(coarse.triangles.size(), before);
    before = coarse.triangles.size();
  }
  EXPECT_LT(before, sphere.triangles.size() / 8);
}

// To be soon would be of no use with many more triangles.
TEST(Coarsen, NeedsFewMoreTrianglesThanSimplification) {
  const TriangleMesh torus = torus_surface(20.0f, 6.0f, 120, 60);
  SimplifyOptions options;
  options.error_tolerance = 0.2;
  options.field = torus_field;
  const TriangleMesh coarse = coarsen(torus, torus_field, {.error_tolerance = 0.2});
  expect_sound(coarse, 0);
  EXPECT_LT(static_cast<double>(coarse.triangles.size()),
            1.3 * static_cast<double>(simplify(torus, options).triangles.size()));
}

// Where a surface is already worse than the tolerance, what is new keeps it all the same.
TEST(Coarsen, LeavesWhatIsAlreadyWorse) {
  const TriangleMesh sphere = sphere_surface(kRadius, 20);
  const SurfaceField field = [](const glm::dvec3& p) {
    FieldSample at = sphere_field(p);
    if (p.x > 8.0) at.error -= 3.0;
    return at;
  };
  const TriangleMesh coarse = coarsen(sphere, field, {.error_tolerance = 0.1});
  expect_sound(coarse, 2);
  EXPECT_LT(coarse.triangles.size(), sphere.triangles.size() / 2);
  EXPECT_LE(testing::largest_error(coarse, sphere_error, kDense), 0.1 * 1.15);
}

// Caps: where the field says nothing, triangles keep to their own planes.
TEST(Coarsen, FlatSidesStayFlat) {
  const SurfaceField nothing = [](const glm::dvec3&) { return FieldSample{0.0, glm::dvec3(0.0)}; };
  const TriangleMesh coarse = coarsen(cube_surface(5.0f, 10), nothing, {.error_tolerance = 1e-3});
  expect_sound(coarse, 2);
  EXPECT_LT(coarse.triangles.size(), 100u);
  EXPECT_NEAR(check_shell(coarse).volume_mm3, 1000.0, 0.1);
}

TEST(Coarsen, NeverTakesTheLastTriangles) {
  expect_sound(coarsen(sphere_surface(kRadius, 6), sphere_field, {.error_tolerance = 100.0}), 2);
  expect_sound(coarsen(torus_surface(20.0f, 6.0f, 20, 10), torus_field, {.error_tolerance = 100.0}),
               0);
  EXPECT_TRUE(coarsen({}, sphere_field, {.error_tolerance = 0.1}).triangles.empty());
}

TEST(Coarsen, RefusesAnOpenSurface) {
  TriangleMesh open = sphere_surface(kRadius, 6);
  open.triangles.pop_back();
  EXPECT_THROW(coarsen(open, sphere_field, {.error_tolerance = 0.1}), Error);
}

}  // namespace
}  // namespace nacre

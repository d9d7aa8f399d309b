#include "shells/simplify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/error.h"
#include "shells/shell_checks.h"
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
using testing::turned_inside_out;

constexpr float kRadius = 10.0f;
constexpr int kDense = 7;  // parts of a triangle's side

double sphere_error(const glm::dvec3& p) { return std::abs(glm::length(p) - double{kRadius}); }

constexpr testing::SphereField sphere_field{double{kRadius}};

double largest_error(const TriangleMesh& mesh, const testing::PointError& error) {
  return testing::largest_error(mesh, error, kDense);
}

TEST(Simplify, WithoutBoundsNothingChanges) {
  const TriangleMesh sphere = sphere_surface(kRadius, 8);
  EXPECT_EQ(simplify(sphere, {}).triangles, sphere.triangles);
}

TEST(Simplify, KeepsTheErrorBound) {
  const TriangleMesh sphere = sphere_surface(kRadius, 20);
  std::size_t before = sphere.triangles.size();
  for (const double tolerance : {0.1, 0.5}) {
    SimplifyOptions options;
    options.error_tolerance = tolerance;
    options.field = sphere_field;
    const TriangleMesh coarse = simplify(sphere, options);
    expect_sound(coarse, 2);
    EXPECT_LE(largest_error(coarse, sphere_error), tolerance * 1.15) << "between the samples";
    EXPECT_LT(coarse.triangles.size(), before);
    before = coarse.triangles.size();
  }
  EXPECT_LT(before, sphere.triangles.size() / 8);
}

// Where a surface is already worse than the tolerance it may stay so, but not spread.
TEST(Simplify, LeavesWhatIsAlreadyWorse) {
  const TriangleMesh sphere = sphere_surface(kRadius, 20);
  SimplifyOptions options;
  options.error_tolerance = 0.04;
  options.field = [](const glm::dvec3& p) {
    FieldSample at = sphere_field(p);
    if (p.x > 8.0) at.error -= 0.3;
    return at;
  };
  const TriangleMesh coarse = simplify(sphere, options);
  expect_sound(coarse, 2);
  EXPECT_LT(coarse.triangles.size(), sphere.triangles.size());
  // Away from the bad region, and from triangles that reach into it.
  const auto elsewhere = [](const glm::dvec3& p) { return p.x < 2.0 ? sphere_error(p) : 0.0; };
  EXPECT_LE(largest_error(coarse, elsewhere), 0.04 * 1.15);
}

TEST(Simplify, KeepsTheDistanceBound) {
  const TriangleMesh torus = torus_surface(20.0f, 6.0f, 60, 30);
  for (const double tolerance : {0.4, 1.0}) {
    SimplifyOptions options;
    options.tolerance_mm = tolerance;
    const TriangleMesh coarse = simplify(torus, options);
    expect_sound(coarse, 0);
    EXPECT_LT(coarse.triangles.size(), torus.triangles.size() / 2);
    const auto torus_error = [](const glm::dvec3& p) {
      const double ring = std::hypot(p.x, p.y) - 20.0;
      return std::abs(std::hypot(ring, p.z) - 6.0);
    };
    EXPECT_LE(largest_error(coarse, torus_error), tolerance + largest_error(torus, torus_error));
  }
}

TEST(Simplify, FlatSidesCostNothing) {
  SimplifyOptions options;
  options.tolerance_mm = 1e-3;
  const TriangleMesh coarse = simplify(cube_surface(5.0f, 10), options);
  expect_sound(coarse, 2);
  EXPECT_LT(coarse.triangles.size(), 100u);
  EXPECT_NEAR(check_shell(coarse).volume_mm3, 1000.0, 0.1);
}

TEST(Simplify, StopsAtTheTarget) {
  SimplifyOptions options;
  options.target_triangles = 500;
  const TriangleMesh coarse = simplify(sphere_surface(kRadius, 15), options);
  expect_sound(coarse, 2);
  EXPECT_LE(coarse.triangles.size(), 500u);
  EXPECT_GE(coarse.triangles.size(), 498u);
  EXPECT_LT(largest_error(coarse, sphere_error), 0.5);
}

TEST(Simplify, ATargetNeverTakesTheLastTriangles) {
  SimplifyOptions options;
  options.target_triangles = 1;
  expect_sound(simplify(sphere_surface(kRadius, 6), options), 2);
  expect_sound(simplify(torus_surface(9.0f, 3.0f, 20, 10), options), 0);
}

TEST(Simplify, SameInputSameResult) {
  SimplifyOptions options;
  options.target_triangles = 300;
  const TriangleMesh torus = torus_surface(9.0f, 3.0f, 60, 30);
  EXPECT_EQ(simplify(torus, options).positions, simplify(torus, options).positions);
}

TEST(Simplify, RefusesAnOpenSurface) {
  TriangleMesh open = sphere_surface(kRadius, 6);
  open.triangles.pop_back();
  SimplifyOptions options;
  options.target_triangles = 10;
  EXPECT_THROW(simplify(open, options), Error);
}

}  // namespace
}  // namespace nacre

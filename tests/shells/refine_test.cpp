#include "shells/refine.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/error.h"
#include "shells/shell_checks.h"
#include "tests/support/analytic_surfaces.h"
#include "tests/support/dense_error.h"
#include "tests/support/sphere_field.h"

namespace nacre {
namespace {

constexpr double kRadius = 10.0;

constexpr testing::SphereField sphere_field{kRadius};

double largest_error(const TriangleMesh& mesh) {
  return testing::largest_error(
      mesh, [](const glm::dvec3& p) { return std::abs(sphere_field(p).error); }, 6);
}

// The sagitta of a chord: halving edges quarters the error.
TEST(Refine, ErrorFallsWithTheSquareOfTheEdges) {
  const TriangleMesh sphere = testing::sphere_surface(static_cast<float>(kRadius), 5);
  RefineOptions options{.error_tolerance = 1e-3, .reach_mm = 2.0, .rounds = 1};
  const TriangleMesh once = refine(sphere, sphere_field, options);
  EXPECT_EQ(once.triangles.size(), 4 * sphere.triangles.size());
  EXPECT_TRUE(check_shell(once).is_sound());
  EXPECT_NEAR(largest_error(sphere) / largest_error(once), 4.0, 0.8);
  options.rounds = 2;
  EXPECT_NEAR(largest_error(sphere) / largest_error(refine(sphere, sphere_field, options)), 16.0,
              5.0);
}

TEST(Refine, LeavesWhatFollowsTheFieldAsItIs) {
  const TriangleMesh sphere = testing::sphere_surface(static_cast<float>(kRadius), 12);
  const TriangleMesh same =
      refine(sphere, sphere_field, {.error_tolerance = 0.2, .reach_mm = 1.0, .rounds = 3});
  EXPECT_EQ(same.triangles, sphere.triangles);
}

// Only one side strays: neighbours of divided triangles become two or three, and stay closed.
TEST(Refine, DividesOnlyWhereTheSurfaceStrays) {
  const TriangleMesh sphere = testing::sphere_surface(static_cast<float>(kRadius), 8);
  const SurfaceField one_side = [](const glm::dvec3& p) {
    return p.x > 2.0 ? sphere_field(p) : FieldSample{0.0, glm::dvec3(0.0)};
  };
  const TriangleMesh refined = refine(sphere, one_side, {.error_tolerance = 0.01, .reach_mm = 2.0});
  EXPECT_GT(refined.triangles.size(), sphere.triangles.size());
  EXPECT_LT(refined.triangles.size(), 3 * sphere.triangles.size());
  const ShellReport report = check_shell(refined);
  EXPECT_TRUE(report.is_sound());
  EXPECT_EQ(report.euler, 2);
}

// A field whose zero is far off to one side, at one edge only, would pull a vertex over its
// neighbours.
TEST(Refine, NeverTurnsAPartOver) {
  const TriangleMesh cube = testing::cube_surface(5.0f, 6);
  const SurfaceField skew = [](const glm::dvec3& p) {
    const glm::dvec3 pull(0.3, 0.9, 0.1);
    return FieldSample{1.0 - 0.9 * glm::dot(pull, glm::fract(3.0 * p)), pull};
  };
  const TriangleMesh refined = refine(cube, skew, {.error_tolerance = 0.01, .reach_mm = 5.0});
  EXPECT_EQ(refined.triangles.size(), 4 * cube.triangles.size());
  const auto normal = [](const TriangleMesh& mesh, std::size_t t) {
    const glm::uvec3 c = mesh.triangles[t];
    const glm::dvec3 a(mesh.positions[c.x]);
    return glm::normalize(
        glm::cross(glm::dvec3(mesh.positions[c.y]) - a, glm::dvec3(mesh.positions[c.z]) - a));
  };
  // Four parts a triangle, in the order of the triangles.
  for (std::size_t t = 0; t < refined.triangles.size(); ++t) {
    EXPECT_GE(glm::dot(normal(refined, t), normal(cube, t / 4)), 0.0499) << "part " << t;
  }
}

TEST(Refine, RefusesAnOpenSurface) {
  TriangleMesh open = testing::sphere_surface(5.0f, 3);
  open.triangles.pop_back();
  EXPECT_THROW(refine(open, sphere_field, {}), Error);
}

}  // namespace
}  // namespace nacre

#include "shells/star_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "core/quantization_grid.h"
#include "shells/grid_fit.h"
#include "tests/support/analytic_surfaces.h"
#include "tests/support/dense_error.h"
#include "tests/support/sphere_field.h"

namespace nacre {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kRadius = 10.0;

constexpr testing::SphereField sphere_field{kRadius};

struct Sphere {
  TriangleMesh surface = testing::sphere_surface(static_cast<float>(kRadius), 6);
  ClosedMesh mesh{surface.triangles, surface.positions.size()};
  std::vector<glm::dvec3> positions{surface.positions.begin(), surface.positions.end()};

  Star star(std::uint32_t vertex) const {
    Star star;
    star_of_vertex(mesh, positions, vertex, star);
    return star;
  }
};

TEST(StarFit, BringsAnApexBackToTheSurface) {
  const Sphere sphere;
  const SurfaceField field = sphere_field;
  StarFit fit(field, glm::dmat3(1.0));
  for (const std::uint32_t v : {0u, 17u, 100u}) {
    const Star star = sphere.star(v);
    const std::vector<double> allowed(star.triangles.size(), kUnbounded);
    glm::dvec3 p = 1.08 * sphere.positions[v];
    ASSERT_TRUE(fit.sample(star, p, allowed));
    const double before = fit.sum_of_squares();
    p += fit.step();
    ASSERT_TRUE(fit.sample(star, p, allowed));
    EXPECT_LT(fit.sum_of_squares(), 0.1 * before);
    // Outside the sphere, so that triangles are half in and half out.
    EXPECT_GT(glm::length(p), kRadius);
    EXPECT_LT(glm::length(p), 1.03 * kRadius);
  }
}

// What `change` says of a small step is what sampling again finds.
TEST(StarFit, TellsHowTheSumOfSquaresChanges) {
  const Sphere sphere;
  const SurfaceField field = sphere_field;
  StarFit fit(field, glm::dmat3(0.01));  // the same number of samples wherever the apex is
  const Star star = sphere.star(40);
  const std::vector<double> allowed(star.triangles.size(), kUnbounded);
  const glm::dvec3 p = 1.05 * sphere.positions[40];
  for (const glm::dvec3& d : {glm::dvec3(0.01, 0, 0), glm::dvec3(-0.02, 0.01, 0.015)}) {
    ASSERT_TRUE(fit.sample(star, p, allowed));
    const double here = fit.sum_of_squares();
    const double told = fit.change(d);
    ASSERT_TRUE(fit.sample(star, p + d, allowed));
    EXPECT_NEAR(fit.sum_of_squares() - here, told, 0.1 * std::abs(told));
  }
}

TEST(StarFit, TellsWhatIsPastTheBound) {
  const Sphere sphere;
  const SurfaceField field = sphere_field;
  StarFit fit(field, glm::dmat3(1.0));
  const Star star = sphere.star(3);
  const std::vector<double> tight(star.triangles.size(), 0.3);
  EXPECT_TRUE(fit.sample(star, sphere.positions[3], tight));
  EXPECT_TRUE(fit.is_within());
  EXPECT_TRUE(fit.sample(star, 1.05 * sphere.positions[3], tight)) << "not out of proportion";
  EXPECT_FALSE(fit.is_within());
  EXPECT_FALSE(fit.sample(star, 1.2 * sphere.positions[3], tight));
  for (const double error : fit.triangle_errors()) EXPECT_GE(error, 0.0);
}

// A vertex on the surface, its triangles sagging below: samples see what a dense look sees.
TEST(StarFit, SeesNearlyTheLargestError) {
  const Sphere sphere;
  const SurfaceField field = sphere_field;
  StarFit fit(field, glm::dmat3(4.0));
  const auto error = [](const glm::dvec3& p) { return std::abs(sphere_field(p).error); };
  for (std::uint32_t v = 0; v < sphere.positions.size(); v += 11) {
    const Star star = sphere.star(v);
    const std::vector<double> allowed(star.triangles.size(), kUnbounded);
    ASSERT_TRUE(fit.sample(star, sphere.positions[v], allowed));
    for (std::size_t i = 0; i < star.triangles.size(); ++i) {
      double dense = 0.0;
      testing::visit_lattice(sphere.positions[v], star.ring[i], star.after(i), 20,
                             [&](const glm::dvec3& p) { dense = std::max(dense, error(p)); });
      EXPECT_GE(fit.triangle_errors()[i], 0.8 * dense);
      EXPECT_LE(fit.triangle_errors()[i], dense * 1.0001);
    }
  }
}

TEST(GridFit, PutsVerticesOnTheGridBetterThanRoundingDoes) {
  const Sphere sphere;
  const SurfaceField field = sphere_field;
  const QuantizationGrid grid{glm::dvec3(-16.0), 31.75, 7};  // a step of 1/4
  ASSERT_TRUE(is_exact(grid));
  std::vector<glm::dvec3> fitted = sphere.positions;
  fit_to_grid(sphere.mesh, field, glm::dmat3(1.0), grid, fitted);
  double sum_fitted = 0.0;
  double sum_rounded = 0.0;
  for (std::size_t v = 0; v < fitted.size(); ++v) {
    EXPECT_TRUE(is_on(grid, glm::vec3(fitted[v])));
    EXPECT_LE(glm::length(fitted[v] - sphere.positions[v]), 2.5 * 0.25 * std::sqrt(3.0));
    const glm::dvec3 rounded(grid_position(grid, nearest_index(grid, sphere.positions[v])));
    sum_fitted += std::pow(sphere_field(fitted[v]).error, 2);
    sum_rounded += std::pow(sphere_field(rounded).error, 2);
  }
  EXPECT_LT(sum_fitted, sum_rounded);
}

/// Squared error over a surface's triangles, densely.
double squared_error(const Sphere& sphere, std::span<const glm::dvec3> positions) {
  double sum = 0.0;
  for (const glm::uvec3& t : sphere.surface.triangles) {
    testing::visit_lattice(positions[t.x], positions[t.y], positions[t.z], 8,
                           [&](const glm::dvec3& p) { sum += std::pow(sphere_field(p).error, 2); });
  }
  return sum;
}

// The steps are the same; a tenth of a sample lies between the two densities of samples.
TEST(GridFit, GoesOverVerticesTwiceWhereStepsAreCoarse) {
  const Sphere sphere;
  const SurfaceField field = sphere_field;
  const QuantizationGrid grid{glm::dvec3(-16.0), 31.75, 7};
  std::vector<glm::dvec3> once = sphere.positions;
  std::vector<glm::dvec3> twice = sphere.positions;
  fit_to_grid(sphere.mesh, field, glm::dmat3(0.39), grid, once);
  fit_to_grid(sphere.mesh, field, glm::dmat3(0.41), grid, twice);
  EXPECT_LT(squared_error(sphere, twice), 0.98 * squared_error(sphere, once));
  for (const glm::dvec3& p : twice) EXPECT_TRUE(is_on(grid, glm::vec3(p)));
}

TEST(GridFit, LeavesPinnedVerticesWhereTheyAre) {
  const Sphere sphere;
  const SurfaceField pinned = [](const glm::dvec3&) { return FieldSample{0.0, glm::dvec3(0.0)}; };
  const QuantizationGrid grid{glm::dvec3(-16.0), 31.75, 7};
  std::vector<glm::dvec3> fitted = sphere.positions;
  fit_to_grid(sphere.mesh, pinned, glm::dmat3(1.0), grid, fitted);
  for (std::size_t v = 0; v < fitted.size(); ++v) {
    EXPECT_EQ(fitted[v], glm::dvec3(grid_position(grid, nearest_index(grid, sphere.positions[v]))));
  }
}

}  // namespace
}  // namespace nacre

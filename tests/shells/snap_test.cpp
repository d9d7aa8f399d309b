#include "shells/snap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "core/quantization_grid.h"
#include "shells/shell_checks.h"
#include "tests/support/analytic_surfaces.h"

namespace nacre {
namespace {

using testing::cube_surface;
using testing::moved;
using testing::sphere_surface;
using testing::together;
using testing::torus_surface;
using testing::turned_inside_out;

/// A grid of twelve bits around the origin.
QuantizationGrid grid_with_step(double step) {
  return {glm::dvec3(-2048.0 * step), 4095.0 * step, 12};
}

constexpr double kStep = 1.0 / 64.0;

void expect_clean(const TriangleMesh& mesh, const QuantizationGrid& grid) {
  const ShellReport report = check_shell(mesh);
  EXPECT_TRUE(report.is_closed());
  EXPECT_TRUE(report.is_manifold());
  EXPECT_EQ(report.coincident_vertices, 0u);
  EXPECT_EQ(report.degenerate, 0u);
  EXPECT_EQ(report.vertices, mesh.positions.size());
  for (const glm::vec3& p : mesh.positions) ASSERT_TRUE(is_on(grid, p));
}

TEST(Snap, MovesNothingFurtherThanHalfAStep) {
  const QuantizationGrid grid = grid_with_step(kStep);
  const TriangleMesh sphere = sphere_surface(10.0f, 12);
  const SnappedSurface snapped = snap(sphere, grid);
  ASSERT_EQ(snapped.mesh.positions.size(), sphere.positions.size());
  EXPECT_EQ(snapped.mesh.triangles, sphere.triangles);
  for (std::size_t v = 0; v < sphere.positions.size(); ++v) {
    const glm::vec3 d = glm::abs(snapped.mesh.positions[v] - sphere.positions[v]);
    EXPECT_LE(std::max({d.x, d.y, d.z}), 0.5 * kStep);
  }
  expect_clean(snapped.mesh, grid);
}

TEST(Snap, IsAFixedPoint) {
  const QuantizationGrid grid = grid_with_step(0.25);
  const TriangleMesh once = snap(torus_surface(10.0f, 3.0f, 80, 40), grid).mesh;
  const SnappedSurface twice = snap(once, grid);
  EXPECT_EQ(twice.mesh.positions, once.positions);
  EXPECT_EQ(twice.mesh.triangles, once.triangles);
}

// Triangles far below a step: most collapse, the topology stays.
TEST(Snap, CleansWhatCollapses) {
  const QuantizationGrid grid = grid_with_step(1.0);
  for (const TriangleMesh& mesh :
       {sphere_surface(12.3f, 50), torus_surface(20.0f, 6.0f, 200, 60)}) {
    const SnappedSurface snapped = snap(mesh, grid);
    expect_clean(snapped.mesh, grid);
    EXPECT_GT(snapped.report.collapsed_edges, mesh.positions.size() / 2);
    EXPECT_EQ(check_shell(snapped.mesh).euler, check_shell(mesh).euler);
    const double volume = check_shell(mesh).volume_mm3;
    EXPECT_NEAR(check_shell(snapped.mesh).volume_mm3, volume, 0.1 * volume);
  }
}

TEST(Snap, KeepsTouchingSheetsApart) {
  const QuantizationGrid grid = grid_with_step(kStep);
  const float gap = 0.2f * static_cast<float>(kStep);
  const TriangleMesh two = together(moved(cube_surface(1.0f, 8), {-1.0f, 0, 0}),
                                    moved(cube_surface(1.0f, 8), {1.0f + gap, 0, 0}));
  const SnappedSurface snapped = snap(two, grid);
  expect_clean(snapped.mesh, grid);
  EXPECT_EQ(check_shell(snapped.mesh).components, 2u);
  EXPECT_GE(snapped.report.moved_vertices, 81u);
}

TEST(Snap, KeepsASheetThinnerThanAStep) {
  const QuantizationGrid grid = grid_with_step(kStep);
  TriangleMesh wedge = cube_surface(2.0f, 12);
  for (glm::vec3& p : wedge.positions) p.z *= 0.01f + 0.01f * p.x;
  const SnappedSurface snapped = snap(wedge, grid);
  expect_clean(snapped.mesh, grid);
  EXPECT_EQ(check_shell(snapped.mesh).euler, 2);
  EXPECT_GT(check_shell(snapped.mesh).volume_mm3, 0.0);
}

TEST(Snap, ASheetWithoutVolumeVanishes) {
  TriangleMesh plate = cube_surface(2.0f, 12);
  for (glm::vec3& p : plate.positions) p.z *= 1e-3f;
  const SnappedSurface snapped = snap(plate, grid_with_step(kStep));
  EXPECT_TRUE(snapped.mesh.triangles.empty());
  EXPECT_EQ(snapped.report.dropped_components, 1u);
}

TEST(Snap, SpecksBelowAStepVanish) {
  const QuantizationGrid grid = grid_with_step(kStep);
  TriangleMesh mesh = sphere_surface(4.0f, 8);
  for (int i = 0; i < 5; ++i) {
    const float x = 6.0f + 0.1f * static_cast<float>(i);
    mesh = together(mesh, moved(sphere_surface(1e-4f, 3), {x, 0, 0}));
  }
  const SnappedSurface snapped = snap(mesh, grid);
  expect_clean(snapped.mesh, grid);
  EXPECT_EQ(check_shell(snapped.mesh).components, 1u);
  EXPECT_EQ(snapped.report.dropped_components, 5u);
}

TEST(Snap, KeepsCavities) {
  const QuantizationGrid grid = grid_with_step(kStep);
  const TriangleMesh hollow =
      together(sphere_surface(4.0f, 10), turned_inside_out(sphere_surface(2.0f, 8)));
  const SnappedSurface snapped = snap(hollow, grid);
  expect_clean(snapped.mesh, grid);
  EXPECT_EQ(check_shell(snapped.mesh).components, 2u);
  EXPECT_EQ(snapped.report.dropped_components, 0u);
}

// Slivers along grid lines: exactly collinear corners after snapping.
TEST(Snap, ResolvesCollinearTriangles) {
  const QuantizationGrid grid = grid_with_step(1.0);
  TriangleMesh cube = cube_surface(8.0f, 8);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> sideways(-1.4f, 1.4f);
  for (glm::vec3& p : cube.positions) p += glm::vec3(sideways(random), sideways(random), 0.0f);
  const SnappedSurface snapped = snap(cube, grid);
  expect_clean(snapped.mesh, grid);
  EXPECT_GT(snapped.report.flipped_edges + snapped.report.moved_vertices, 0u);
}

TEST(Snap, SurvivesNoise) {
  const QuantizationGrid grid = grid_with_step(0.5);
  for (unsigned seed = 1; seed <= 8; ++seed) {
    TriangleMesh mesh = torus_surface(8.0f, 3.0f, 60, 40);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> offset(-1.0f, 1.0f);
    for (glm::vec3& p : mesh.positions)
      p += glm::vec3(offset(random), offset(random), offset(random));
    expect_clean(snap(mesh, grid).mesh, grid);
  }
}

TEST(Snap, RefusesAGridThatCannotHoldTheSurface) {
  const QuantizationGrid four_points{glm::dvec3(-8.0), 16.0, 1};
  EXPECT_THROW(snap(sphere_surface(8.0f, 40), four_points), Error);
  EXPECT_THROW(snap(sphere_surface(1.0f, 4), {glm::dvec3(-8.0), 0.1, 12}), Error);
}

TEST(Snap, AnEmptySurfaceStaysEmpty) {
  EXPECT_TRUE(snap({}, grid_with_step(1.0)).mesh.triangles.empty());
}

}  // namespace
}  // namespace nacre

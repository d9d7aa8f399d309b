#include "shells/shell_checks.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/analytic_surfaces.h"

namespace nacre {
namespace {

using testing::cube_surface;
using testing::moved;
using testing::sphere_surface;
using testing::together;
using testing::torus_surface;
using testing::turned_inside_out;

TEST(ShellChecks, MeasuresACube) {
  const ShellReport report = check_shell(cube_surface(1.5f, 4));
  EXPECT_TRUE(report.is_sound());
  EXPECT_EQ(report.triangles, 12u * 16u);
  EXPECT_EQ(report.vertices, 6u * 16u + 2u);
  EXPECT_EQ(report.euler, 2);
  EXPECT_DOUBLE_EQ(report.volume_mm3, 27.0);
  EXPECT_DOUBLE_EQ(report.area_mm2, 54.0);
}

TEST(ShellChecks, TellsATorusFromASphere) {
  EXPECT_EQ(check_shell(torus_surface(3.0f, 1.0f, 24, 12)).euler, 0);
  EXPECT_EQ(check_shell(sphere_surface(3.0f, 6)).euler, 2);
}

// Inscribed, so off by the second order of the edge length.
TEST(ShellChecks, ApproachesTheSpheresVolumeAndArea) {
  constexpr double kPi = std::numbers::pi;
  const ShellReport report = check_shell(sphere_surface(2.0f, 30));
  EXPECT_NEAR(report.volume_mm3, 32.0 / 3.0 * kPi, 0.006 * report.volume_mm3);
  EXPECT_NEAR(report.area_mm2, 16.0 * kPi, 0.004 * report.area_mm2);
}

TEST(ShellChecks, CountsComponents) {
  const ShellReport report =
      check_shell(together(sphere_surface(1.0f, 3), moved(cube_surface(1.0f), {4, 0, 0})));
  EXPECT_EQ(report.components, 2u);
  EXPECT_EQ(report.euler, 4);
  EXPECT_TRUE(report.is_sound());
}

TEST(ShellChecks, FindsAHole) {
  TriangleMesh mesh = cube_surface(1.0f, 2);
  mesh.triangles.pop_back();
  const ShellReport report = check_shell(mesh);
  EXPECT_EQ(report.open_edges, 3u);
  EXPECT_FALSE(report.is_closed());
}

TEST(ShellChecks, FindsATurnedTriangle) {
  TriangleMesh mesh = cube_surface(1.0f, 2);
  std::swap(mesh.triangles[0].x, mesh.triangles[0].y);
  const ShellReport report = check_shell(mesh);
  EXPECT_EQ(report.misoriented_edges, 3u);
  EXPECT_EQ(report.open_edges, 0u);
  EXPECT_FALSE(report.is_closed());
}

TEST(ShellChecks, FindsASurfaceInsideOut) {
  const ShellReport report = check_shell(turned_inside_out(cube_surface(1.0f)));
  EXPECT_TRUE(report.is_closed());
  EXPECT_LT(report.volume_mm3, 0.0);
  EXPECT_FALSE(report.is_sound());
}

/// Two unit tetrahedra that share the vertices 0 to shared - 1.
TriangleMesh two_tetrahedra(std::uint32_t shared) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},  {0, 0, 1},
                    {0, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  const auto add = [&](std::array<std::uint32_t, 4> v) {
    for (std::uint32_t& vertex : v) {
      if (vertex >= 4 && vertex < 4 + shared) vertex -= 4;
    }
    mesh.triangles.insert(
        mesh.triangles.end(),
        {{v[0], v[2], v[1]}, {v[0], v[1], v[3]}, {v[0], v[3], v[2]}, {v[1], v[2], v[3]}});
  };
  add({0, 1, 2, 3});
  add({4, 5, 6, 7});
  return mesh;
}

TEST(ShellChecks, FindsWhereSheetsTouch) {
  const ShellReport edge = check_shell(two_tetrahedra(2));
  EXPECT_EQ(edge.crowded_edges, 1u);
  EXPECT_TRUE(edge.is_closed());
  EXPECT_FALSE(edge.is_manifold());

  const ShellReport vertex = check_shell(two_tetrahedra(1));
  EXPECT_EQ(vertex.crowded_edges, 0u);
  EXPECT_EQ(vertex.crowded_vertices, 1u);
  EXPECT_FALSE(vertex.is_manifold());

  const ShellReport apart = check_shell(two_tetrahedra(0));
  EXPECT_TRUE(apart.is_manifold());
  EXPECT_EQ(apart.coincident_vertices, 2u);
  EXPECT_FALSE(apart.is_sound());
}

TEST(ShellChecks, FindsTrianglesWithoutArea) {
  TriangleMesh mesh = cube_surface(1.0f, 2);
  for (glm::vec3& p : mesh.positions) {
    if (p == glm::vec3(0, 0, 1)) p = {1.0f, 0.5f, 1.0f};  // onto the square's far side
  }
  EXPECT_GT(check_shell(mesh).degenerate, 0u);
}

TEST(ShellChecks, AnEmptySurfaceIsSound) { EXPECT_TRUE(check_shell({}).is_sound()); }

}  // namespace
}  // namespace nacre

#include "shells/closed_mesh.h"

#include <gtest/gtest.h>

#include <random>

#include "core/error.h"
#include "shells/shell_checks.h"
#include "tests/support/analytic_surfaces.h"

namespace nacre {
namespace {

using testing::cube_surface;
using testing::sphere_surface;
using testing::together;
using testing::torus_surface;

/// The connectivity as a mesh of the original positions.
TriangleMesh as_mesh(const ClosedMesh& closed, const TriangleMesh& original) {
  TriangleMesh mesh;
  for (std::uint32_t v = 0; v < closed.vertex_count(); ++v) {
    mesh.positions.push_back(original.positions[closed.source(v)]);
  }
  for (std::size_t t = 0; t < closed.triangle_count(); ++t) {
    if (closed.is_alive(t)) mesh.triangles.push_back(closed.triangle(t));
  }
  return mesh;
}

ClosedMesh closed_mesh(const TriangleMesh& mesh) { return {mesh.triangles, mesh.positions.size()}; }

TEST(ClosedMesh, KeepsWhatItIsGiven) {
  const TriangleMesh torus = torus_surface(3.0f, 1.0f, 9, 7);
  EXPECT_EQ(as_mesh(closed_mesh(torus), torus).triangles, torus.triangles);
}

TEST(ClosedMesh, SplitsAVertexWhereTwoFansTouch) {
  TriangleMesh mesh = together(cube_surface(1.0f), cube_surface(2.0f));
  for (glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) t[i] = t[i] == 8 ? 0 : t[i];
  }
  const ClosedMesh closed = closed_mesh(mesh);
  EXPECT_EQ(closed.vertex_count(), 17u);
  EXPECT_EQ(closed.source(16), 0u);
  EXPECT_TRUE(check_shell(as_mesh(closed, mesh)).is_manifold());
}

TEST(ClosedMesh, RefusesWhatIsNotClosedOrOriented) {
  TriangleMesh open = cube_surface(1.0f);
  open.triangles.pop_back();
  EXPECT_THROW(closed_mesh(open), Error);
  TriangleMesh turned = cube_surface(1.0f);
  std::swap(turned.triangles[3].x, turned.triangles[3].y);
  EXPECT_THROW(closed_mesh(turned), Error);
  TriangleMesh twice = cube_surface(1.0f);
  twice.triangles.insert(twice.triangles.end(), twice.triangles.begin(), twice.triangles.end());
  EXPECT_THROW(closed_mesh(twice), Error);
  TriangleMesh folded = cube_surface(1.0f);
  folded.triangles[0].y = folded.triangles[0].x;
  EXPECT_THROW(closed_mesh(folded), Error);
}

TEST(ClosedMesh, ATetrahedronCannotCollapse) {
  const std::vector<glm::uvec3> tetrahedron{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const ClosedMesh closed(tetrahedron, 4);
  for (std::uint32_t h = 0; h < 12; ++h) {
    EXPECT_FALSE(closed.can_collapse(h));
    EXPECT_FALSE(closed.can_flip(h));
  }
}

/// Collapses and flips at random for as long as anything is allowed.
TEST(ClosedMesh, StaysAManifoldOfTheSameTopology) {
  for (const TriangleMesh& mesh :
       {torus_surface(3.0f, 1.0f, 12, 8), sphere_surface(1.0f, 6), cube_surface(1.0f, 3)}) {
    const std::int64_t euler = check_shell(mesh).euler;
    ClosedMesh closed = closed_mesh(mesh);
    std::mt19937 random(1);
    for (int i = 0; i < 20'000; ++i) {
      const auto h = static_cast<std::uint32_t>(random() % closed.half_edge_count());
      if (!closed.is_alive(h / 3)) continue;
      if (random() % 8 == 0) {
        if (closed.can_collapse(h)) closed.collapse(h);
      } else if (closed.can_flip(h)) {
        closed.flip(h);
      }
      if (i % 500 != 0) continue;
      const ShellReport report = check_shell(as_mesh(closed, mesh));
      ASSERT_TRUE(report.is_closed() && report.is_manifold()) << "step " << i;
      ASSERT_EQ(report.euler, euler) << "step " << i;
    }
    // Nothing more to collapse: a tetrahedron, or the seven vertices of the least torus.
    const ShellReport report = check_shell(as_mesh(closed, mesh));
    EXPECT_LT(report.vertices, euler == 2 ? 12u : 20u);
  }
}

}  // namespace
}  // namespace nacre

#include "core/mesh_summary.h"

#include <gtest/gtest.h>

namespace nacre {
namespace {

const float kFarOff = 1e6F;

/// A unit cube's 12 triangles, outward.
TriangleMesh cube(float x0) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back(x0 + static_cast<float>(i & 1), (i >> 1) & 1, (i >> 2) & 1);
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(MeshSummary, OfAClosedMeshIsItsVolumeAndNoEdges) {
  for (const float x0 : {0.0F, kFarOff}) {
    const MeshSummary summary = summarize(cube(x0));
    EXPECT_EQ(summary.triangles, 12u);
    EXPECT_EQ(summary.vertices, 8u);
    EXPECT_EQ(summary.open_edges, 0u);
    EXPECT_EQ(summary.non_manifold_edges, 0u);
    EXPECT_EQ(summary.signed_volume, 1.0);
    EXPECT_EQ(summary.lo, glm::dvec3(x0, 0, 0));
    EXPECT_EQ(summary.hi, glm::dvec3(x0 + 1.0, 1, 1));
  }
}

TEST(MeshSummary, TurnedOverEnclosesANegativeVolume) {
  TriangleMesh mesh = cube(0.0F);
  for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.x, triangle.y);
  EXPECT_EQ(summarize(mesh).signed_volume, -1.0);
}

TEST(MeshSummary, TakesVerticesAtOnePlaceForOne) {
  const TriangleMesh shared = cube(0.0F);
  TriangleMesh apart;
  for (const glm::uvec3& triangle : shared.triangles) {
    const auto next = static_cast<glm::uint>(apart.positions.size());
    for (int i = 0; i < 3; ++i) {
      apart.positions.push_back(shared.positions[triangle[i]]);
    }
    apart.triangles.emplace_back(next, next + 1, next + 2);
  }
  apart.positions[0].x = -0.0F;
  const MeshSummary summary = summarize(apart);
  EXPECT_EQ(summary.vertices, 8u);
  EXPECT_EQ(summary.open_edges, 0u);
}

TEST(MeshSummary, CountsOpenAndNonManifoldEdges) {
  TriangleMesh mesh = cube(0.0F);
  mesh.triangles.pop_back();
  EXPECT_EQ(summarize(mesh).open_edges, 3u);
  mesh = cube(0.0F);
  mesh.triangles.push_back(mesh.triangles[0]);
  EXPECT_EQ(summarize(mesh).non_manifold_edges, 3u);
  mesh.triangles.push_back({0, 0, 7});
  EXPECT_EQ(summarize(mesh).without_area, 1u);
  EXPECT_EQ(summarize(mesh).non_manifold_edges, 3u);
}

TEST(MeshSummary, OfNothingIsNothing) { EXPECT_EQ(summarize({}).vertices, 0u); }

}  // namespace
}  // namespace nacre

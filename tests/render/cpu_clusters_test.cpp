#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <utility>

#include "render/cpu/detail_levels.h"
#include "render/cpu/mesh_clusters.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {
namespace {

using Triangle = std::array<glm::vec3, 3>;

TriangleMesh two_rings() {
  return join(ring_mesh({}, 25.0, 8.0, 30), ring_mesh({60.0, 0.0, 5.0}, 12.0, 3.0, 20));
}

std::vector<Triangle> triangles_of(const MeshClusters& mesh, const Cluster& cluster) {
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < cluster.triangles; ++t) {
    Triangle triangle;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t vertex =
          mesh.corners[cluster.first_corner + t + corner * cluster.triangles];
      for (int axis = 0; axis < 3; ++axis) {
        triangle[corner][axis] = mesh.positions[cluster.first_position + vertex +
                                                static_cast<std::size_t>(axis) * cluster.vertices];
      }
    }
    if (triangle[0] != triangle[1]) triangles.push_back(triangle);  // else padding
  }
  return triangles;
}

using Key = std::array<float, 9>;

Key key_of(const Triangle& t) {
  return {t[0].x, t[0].y, t[0].z, t[1].x, t[1].y, t[1].z, t[2].x, t[2].y, t[2].z};
}

TEST(MeshClusters, HoldEachTriangleOnce) {
  const TriangleMesh mesh = two_rings();
  std::multiset<Key> expected;
  for (const glm::uvec3& t : mesh.triangles) {
    expected.insert(key_of({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]}));
  }
  const MeshClusters clusters = cluster_mesh(mesh);
  std::multiset<Key> found;
  for (const Cluster& cluster : clusters.clusters) {
    for (const Triangle& triangle : triangles_of(clusters, cluster)) found.insert(key_of(triangle));
  }
  EXPECT_EQ(found, expected);
}

TEST(MeshClusters, LieWithinTheirBoundsAndCones) {
  const MeshClusters clusters = cluster_mesh(two_rings());
  std::size_t cones = 0;
  for (const Cluster& cluster : clusters.clusters) {
    for (const Triangle& t : triangles_of(clusters, cluster)) {
      for (const glm::vec3& p : t) {
        EXPECT_TRUE(
            glm::all(glm::lessThanEqual(glm::abs(p - cluster.center_mm), cluster.extent_mm)));
      }
      if (cluster.cone_sine >= 1.0F) continue;
      ++cones;
      const glm::vec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
      const float cosine = glm::dot(normal, cluster.cone_axis);
      EXPECT_GE(cosine, std::sqrt(1.0F - cluster.cone_sine * cluster.cone_sine));
    }
  }
  EXPECT_GT(cones, 0U);
}

TEST(MeshClusters, AreCompactAndDoNotJoinWhatIsFarApart) {
  const TriangleMesh fine = ball_mesh({}, 50.0, 80);  // edges of 2 mm
  const MeshClusters clusters = cluster_mesh(
      join(fine, join(ball_mesh({500, 0, 0}, 5.0, 4), ball_mesh({0, 500, 0}, 5.0, 4))));
  double sum = 0.0;
  for (const Cluster& cluster : clusters.clusters) {
    const glm::vec3& extent = cluster.extent_mm;
    EXPECT_LT(std::max({extent.x, extent.y, extent.z}), 60.0F);
    sum += std::max({extent.x, extent.y, extent.z});
  }
  // 128 triangles in a square are 8 edges wide: half of that, and a half more for its shape.
  EXPECT_LT(sum / static_cast<double>(clusters.clusters.size()), 1.5 * 8.0);
}

TEST(MeshClusters, NoneOfNoTriangles) { EXPECT_TRUE(cluster_mesh({}).clusters.empty()); }

/// How often each edge is run along, less how often it is run along the other way.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> unbalanced_edges(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t from = t[i];
      const std::uint32_t to = t[(i + 1) % 3];
      balance[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  for (auto edge = balance.begin(); edge != balance.end();) {
    edge = edge->second == 0 ? balance.erase(edge) : std::next(edge);
  }
  return balance;
}

TEST(DetailLevels, StayClosed) {
  const TriangleMesh mesh = two_rings();
  for (const double cell_mm : {0.5, 2.0, 5.0, 20.0}) {
    const MergedVertices merged = merge_vertices(mesh, cell_mm);
    EXPECT_TRUE(unbalanced_edges(merged.mesh).empty()) << cell_mm;
    EXPECT_LE(merged.mesh.triangles.size(), mesh.triangles.size());
  }
}

TEST(DetailLevels, MoveVerticesNoFurtherThanTheirCellsAreWide) {
  const TriangleMesh mesh = two_rings();
  const double cell_mm = 3.0;
  const MergedVertices merged = merge_vertices(mesh, cell_mm);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3 moved = merged.mesh.positions[merged.merged_to[i]] - mesh.positions[i];
    // Half a cell from a mean within the cell.
    EXPECT_LE(std::max({std::abs(moved.x), std::abs(moved.y), std::abs(moved.z)}),
              1.5001 * cell_mm);
  }
}

TEST(DetailLevels, HaveFewerTrianglesAndMoreError) {
  const std::vector<DetailLevel> levels = detail_levels(ball_mesh({}, 50.0, 60), 500);
  ASSERT_GT(levels.size(), 2U);
  EXPECT_EQ(levels.front().error_mm, 0.0);
  for (std::size_t i = 1; i < levels.size(); ++i) {
    EXPECT_LT(levels[i].mesh.triangles, 0.75 * static_cast<double>(levels[i - 1].mesh.triangles));
    EXPECT_GT(levels[i].error_mm, levels[i - 1].error_mm);
  }
  EXPECT_LE(levels.back().mesh.triangles, 500U);
}

TEST(DetailLevels, OnlyTheSurfaceItselfWhereItIsSmall) {
  EXPECT_EQ(detail_levels(block_mesh({0, 0, 0}, {1, 1, 1}), 100).size(), 1U);
}

}  // namespace
}  // namespace nacre::testing

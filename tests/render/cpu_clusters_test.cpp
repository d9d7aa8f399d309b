#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>

#include "render/cpu/mesh_clusters.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {
namespace {

using Triangle = std::array<glm::vec3, 3>;

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

TEST(MeshClusters, HaveTheSameConesInAnyUnit) {
  const MeshClusters expected = cluster_mesh(two_rings());
  for (const int exponent : {-70, -30, 30, 70}) {
    const MeshClusters found = cluster_mesh(scaled(two_rings(), std::ldexp(1.0F, exponent)));
    ASSERT_EQ(found.clusters.size(), expected.clusters.size()) << exponent;
    for (std::size_t i = 0; i < expected.clusters.size(); ++i) {
      EXPECT_EQ(found.clusters[i].cone_axis, expected.clusters[i].cone_axis) << exponent;
      EXPECT_EQ(found.clusters[i].cone_sine, expected.clusters[i].cone_sine) << exponent;
    }
  }
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

}  // namespace
}  // namespace nacre::testing

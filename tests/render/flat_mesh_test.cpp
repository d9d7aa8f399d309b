#include "render/flat_mesh.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <set>

#include "render/vertex_normals.h"
#include "tests/support/nested_shells.h"

namespace nacre {
namespace {

using testing::ball_mesh;
using testing::block_mesh;

TEST(FlatMesh, GivesEachTriangleItsOwnLastVertex) {
  const TriangleMesh ball = ball_mesh({1, 2, 3}, 5.0, 12);
  const FlatMesh flat = flat_mesh(ball.positions, ball.triangles);
  ASSERT_EQ(flat.triangles.size(), ball.triangles.size());
  std::set<std::uint32_t> last;
  for (std::size_t i = 0; i < flat.triangles.size(); ++i) {
    const glm::uvec3& t = flat.triangles[i];
    EXPECT_TRUE(last.insert(t.z).second);
    const glm::dvec3 normal = glm::cross(glm::dvec3(flat.positions[t.y] - flat.positions[t.x]),
                                         glm::dvec3(flat.positions[t.z] - flat.positions[t.x]));
    // Of unit length and, for a ball, outwards: the winding is as it was.
    EXPECT_NEAR(glm::dot(glm::normalize(normal), glm::dvec3(flat.normals[t.z])), 1.0, 1e-6);
    EXPECT_GT(glm::dot(flat.normals[t.z], flat.positions[t.x] - glm::vec3(1, 2, 3)), 0.0F);
  }
  EXPECT_LE(flat.positions.size(), 1.1 * static_cast<double>(ball.triangles.size()));
}

TEST(FlatMesh, KeepsDegenerateTrianglesWithoutANormal) {
  const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<glm::uvec3> triangles{{0, 1, 2}, {0, 0, 1}};
  const FlatMesh flat = flat_mesh(positions, triangles);
  ASSERT_EQ(flat.triangles.size(), 2U);
  for (const glm::uvec3& t : flat.triangles) EXPECT_EQ(flat.normals[t.z], glm::vec3(0.0F));
}

// A cube's corner is the same from three sides, however its squares are cut in two.
TEST(VertexNormals, WeighTrianglesWithTheirAngles) {
  const TriangleMesh cube = block_mesh(glm::dvec3(-1.0), glm::dvec3(1.0));
  const std::vector<glm::vec3> normals = vertex_normals(cube);
  for (std::size_t i = 0; i < cube.positions.size(); ++i) {
    EXPECT_NEAR(glm::length(normals[i] - glm::normalize(cube.positions[i])), 0.0F, 1e-6F);
  }
}

TEST(VertexNormals, AreZeroWhereNoTriangleHasArea) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}}, {{0, 1, 2}}};
  for (const glm::vec3& normal : vertex_normals(mesh)) EXPECT_EQ(normal, glm::vec3(0.0F));
}

}  // namespace
}  // namespace nacre

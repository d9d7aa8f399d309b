#include "shells/star.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <vector>

#include "tests/support/analytic_surfaces.h"

namespace nacre {
namespace {

std::vector<glm::dvec3> positions_of(const TriangleMesh& mesh) {
  return {mesh.positions.begin(), mesh.positions.end()};
}

/// An octahedron about the origin, its top apart.
struct Octahedron {
  ClosedMesh mesh;
  std::vector<glm::dvec3> positions;
};

Octahedron octahedron(const glm::dvec3& top) {
  const std::vector<glm::uvec3> triangles{{4, 0, 1}, {4, 1, 2}, {4, 2, 3}, {4, 3, 0},
                                          {5, 1, 0}, {5, 2, 1}, {5, 3, 2}, {5, 0, 3}};
  return {ClosedMesh(triangles, 6),
          {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, top, {0, 0, -1}}};
}

TEST(Star, OfAVertexHasAllItsTriangles) {
  const Octahedron o = octahedron({0, 0, 1});
  Star star;
  star_of_vertex(o.mesh, o.positions, 4, star);
  ASSERT_EQ(star.ring.size(), 4u);
  EXPECT_TRUE(star.removed.empty());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(star.triangles[i].apex_before, glm::dvec3(0, 0, 1));
    const glm::dvec3 normal =
        glm::cross(star.ring[i] - glm::dvec3(0, 0, 1), star.after(i) - glm::dvec3(0, 0, 1));
    EXPECT_GT(normal.z, 0.0) << "counter-clockwise from outside";
    EXPECT_LT(star.triangles[i].normal_beyond.z, 0.0);
  }
}

// A collapse of an edge takes its two triangles and leaves those around both ends.
TEST(Star, OfACollapseJoinsWhatIsAroundBothEnds) {
  const TriangleMesh sphere = testing::sphere_surface(5.0f, 4);
  const ClosedMesh mesh(sphere.triangles, sphere.positions.size());
  Star star;
  for (std::uint32_t h = 0; h < mesh.half_edge_count(); ++h) {
    star_of_collapse(mesh, positions_of(sphere), h, star);
    EXPECT_EQ(star.triangles.size(), mesh.valence(mesh.from(h)) + mesh.valence(mesh.to(h)) - 4);
    EXPECT_EQ(star.ring.size(), star.triangles.size());
    ASSERT_EQ(star.removed.size(), 2u);
    EXPECT_EQ(star.removed[0].face, h / 3);
  }
}

TEST(Star, KeepsItsShapeUnlessATriangleTurnsOver) {
  const Octahedron o = octahedron({0, 0, 1});
  Star star;
  star_of_vertex(o.mesh, o.positions, 4, star);
  EXPECT_TRUE(keeps_shape(star, {0, 0, 1}));
  EXPECT_TRUE(keeps_shape(star, {0.2, -0.1, 0.7}));
  EXPECT_FALSE(keeps_shape(star, {0, 0, -0.5})) << "through the base";
  EXPECT_FALSE(keeps_shape(star, {0.8, 0.8, 0.2})) << "over a side of the ring";
  EXPECT_FALSE(keeps_shape(star, {0.5, 0.5, 0.0})) << "no area left";
}

TEST(Star, DoesNotFoldOnWhatLiesBeyond) {
  const Octahedron o = octahedron({0, 0, 0.5});
  Star star;
  star_of_vertex(o.mesh, o.positions, 4, star);
  EXPECT_TRUE(keeps_shape(star, {0, 0, 0.4}));
  // Under the ring's plane the triangles lie on those of the lower half, nearly.
  EXPECT_FALSE(keeps_shape(star, {0, 0, -0.9}));
}

TEST(Star, RefusesSlivers) {
  const Octahedron o = octahedron({0, 0, 0.02});
  Star star;
  star_of_vertex(o.mesh, o.positions, 4, star);
  EXPECT_TRUE(keeps_shape(star, {0, 0, 0.01}));
  EXPECT_FALSE(keeps_shape(star, {0.495, 0.495, 0.02})) << "beside a side of the ring";
}

}  // namespace
}  // namespace nacre

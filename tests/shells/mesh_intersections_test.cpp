#include "shells/mesh_intersections.h"

#include <gtest/gtest.h>

#include "tests/support/analytic_surfaces.h"

namespace nacre {
namespace {

using testing::cube_surface;
using testing::moved;
using testing::sphere_surface;
using testing::together;
using testing::torus_surface;

TEST(MeshIntersections, SoundSurfacesHaveNone) {
  EXPECT_EQ(self_intersections(cube_surface(1.0F, 4)), 0u);
  EXPECT_EQ(self_intersections(sphere_surface(2.0F, 8)), 0u);
  EXPECT_EQ(self_intersections(torus_surface(3.0F, 1.0F, 24, 12)), 0u);
  EXPECT_EQ(self_intersections({}), 0u);
}

// One cube's corner in another's: the outline of the common part runs over three sides of each. The
// offset avoids the diagonals, so that each of its six segments lies in one triangle of each cube,
// but for those cut by a diagonal.
TEST(MeshIntersections, CountsTheSameFromBothSidesAndWithin) {
  const TriangleMesh a = cube_surface(1.0F);
  const TriangleMesh b = moved(cube_surface(1.0F), {1.1F, 1.25F, 1.4F});
  const MutualIntersections there = mutual_intersections(a, b);
  const MutualIntersections back = mutual_intersections(b, a);
  EXPECT_GE(there.crossing, 6u);
  EXPECT_EQ(there.crossing, back.crossing);
  EXPECT_EQ(there.touching, 0u);
  EXPECT_EQ(self_intersections(together(a, b)), there.crossing);
}

// A thin needle through a thick plate enters and leaves by one triangle of the plate each (0.3 off
// the sides' diagonals); the needle's four sides have two triangles each, whose diagonal every
// plane across it cuts: 2 * 8 pairs.
TEST(MeshIntersections, ANeedleThroughAPlateCrossesSixteenPairs) {
  TriangleMesh plate = cube_surface(1.0F);
  for (glm::vec3& p : plate.positions) p.z *= 0.1F;
  TriangleMesh needle = cube_surface(1.0F);
  for (glm::vec3& p : needle.positions) p = {0.55F + 0.05F * p.x, 0.2F + 0.05F * p.y, 2.0F * p.z};
  const MutualIntersections count = mutual_intersections(plate, needle);
  EXPECT_EQ(count.crossing, 16u);
  EXPECT_EQ(count.touching, 0u);
}

// As caps of nested shells do in a border plane.
TEST(MeshIntersections, FacesInOnePlaneTouchAndDoNotCross) {
  const TriangleMesh large = cube_surface(1.0F);
  const TriangleMesh small = moved(cube_surface(0.4F), {0.05F, 0.1F, 0.6F});
  const MutualIntersections count = mutual_intersections(large, small);
  EXPECT_EQ(count.crossing, 0u);
  EXPECT_GT(count.touching, 0u);
}

TEST(MeshIntersections, NestedSurfacesHaveNone) {
  const MutualIntersections count =
      mutual_intersections(sphere_surface(2.0F, 8), sphere_surface(1.5F, 8));
  EXPECT_EQ(count.crossing + count.touching, 0u);
}

TEST(MeshIntersections, FindsAFoldedEdgeAndACutCorner) {
  // Two triangles at an edge, the second one folded back onto the first.
  const TriangleMesh folded{{{0, 0, 0}, {1, 0, 0}, {0.2F, 1, 0}, {0.3F, 0.5F, 0}},
                            {{0, 1, 2}, {1, 0, 3}}};
  EXPECT_EQ(self_intersections(folded), 1u);
  // Two that share a vertex; the far side of the second goes through the first.
  const TriangleMesh cut{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5F, 0.5F, -1}, {0.5F, 0.6F, 1}},
                         {{0, 1, 2}, {0, 3, 4}}};
  EXPECT_EQ(self_intersections(cut), 1u);
  // The same, passing beside it.
  const TriangleMesh beside{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {-0.5F, 0.5F, -1}, {-0.5F, 0.6F, 1}},
                            {{0, 1, 2}, {0, 3, 4}}};
  EXPECT_EQ(self_intersections(beside), 0u);
}

}  // namespace
}  // namespace nacre

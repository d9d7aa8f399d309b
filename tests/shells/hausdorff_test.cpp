#include "shells/hausdorff.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "shells/triangle_distance.h"
#include "shells/triangle_tree.h"
#include "tests/support/analytic_surfaces.h"

namespace nacre {
namespace {

using testing::cube_surface;
using testing::moved;
using testing::sphere_surface;
using testing::together;

constexpr double kError = 1e-3;
constexpr double kRounding = 1e-6;  // of float positions about the origin

void expect_distance(const BoundedDistance& found, double expected) {
  EXPECT_LE(found.lower_mm, expected + kRounding);
  EXPECT_GE(found.upper_mm, expected - kRounding);
  EXPECT_LE(found.upper_mm - found.lower_mm, kError + kRounding);
}

TEST(Hausdorff, OfASurfaceToItselfIsNothing) {
  const TriangleMesh mesh = sphere_surface(2.0F, 5);
  expect_distance(hausdorff_distance(mesh, mesh, kError), 0.0);
}

// The farthest points are corners one way, the middles of sides the other.
TEST(Hausdorff, OfNestedCubesDependsOnTheDirection) {
  const TriangleMesh large = cube_surface(2.0F);
  const TriangleMesh small = cube_surface(1.0F);
  expect_distance(hausdorff_distance(large, small, kError), std::sqrt(3.0));
  expect_distance(hausdorff_distance(small, large, kError), 1.0);
}

// No vertex is as far as the middle of the side: only cutting finds it.
TEST(Hausdorff, FindsThePointBetweenVertices) {
  const TriangleMesh plate{{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  TriangleMesh corners;
  for (const glm::vec3& p : plate.positions) {
    const auto first = static_cast<std::uint32_t>(corners.positions.size());
    for (const glm::vec3& offset : {glm::vec3(0), glm::vec3(0, 0, 0.01F), glm::vec3(0.01F, 0, 0)}) {
      corners.positions.push_back(p + offset);
    }
    corners.triangles.emplace_back(first, first + 1, first + 2);
  }
  // The circumcentre is (0, -1/4): as far from all three corners. Their triangles reach 0.01
  // inwards.
  const BoundedDistance found = hausdorff_distance(plate, corners, kError);
  EXPECT_NEAR(found.lower_mm, 1.25, 0.011);
  EXPECT_LE(found.upper_mm - found.lower_mm, kError + kRounding);
}

TEST(Hausdorff, OfAMissingPartIsItsDistance) {
  const TriangleMesh one = cube_surface(1.0F);
  const TriangleMesh two = together(one, moved(cube_surface(0.5F), {5.0F, 0, 0}));
  expect_distance(hausdorff_distance(one, two, kError), 0.0);
  expect_distance(hausdorff_distance(two, one, kError), 4.5);
}

TEST(Hausdorff, OfNothingIsNothingAndToNothingInfinite) {
  const TriangleMesh mesh = cube_surface(1.0F);
  EXPECT_EQ(hausdorff_distance({}, mesh, kError).upper_mm, 0.0);
  EXPECT_TRUE(std::isinf(hausdorff_distance(mesh, {}, kError).lower_mm));
}

TEST(Hausdorff, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh a = sphere_surface(2.0F, 12);
  const TriangleMesh b = moved(sphere_surface(2.1F, 9), {0.05F, 0.02F, 0.0F});
  const BoundedDistance many = hausdorff_distance(a, b, 0.01);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const BoundedDistance single = hausdorff_distance(a, b, 0.01);
  EXPECT_EQ(many.lower_mm, single.lower_mm);
  EXPECT_EQ(many.upper_mm, single.upper_mm);
}

TEST(TriangleTree, FindsWhatBruteForceFinds) {
  const TriangleMesh mesh = sphere_surface(2.0F, 6);
  const TriangleTree tree(mesh);
  for (const glm::dvec3 p :
       {glm::dvec3(0.1, 0.2, 0.3), glm::dvec3(3, 1, -2), glm::dvec3(0, 0, 2)}) {
    double nearest = 1e30;
    for (const glm::uvec3& t : mesh.triangles) {
      nearest = std::min(nearest, squared_distance_to_triangle(p, glm::dvec3(mesh.positions[t.x]),
                                                               glm::dvec3(mesh.positions[t.y]),
                                                               glm::dvec3(mesh.positions[t.z])));
    }
    EXPECT_DOUBLE_EQ(tree.distance(p, 1e30), std::sqrt(nearest));
    EXPECT_EQ(tree.distance(p, 0.5 * std::sqrt(nearest)), 0.5 * std::sqrt(nearest));
  }
}

}  // namespace
}  // namespace nacre

#include "shells/crossings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "core/quantization_grid.h"
#include "shells/build.h"
#include "shells/mesh_intersections.h"
#include "tests/support/analytic_surfaces.h"
#include "tests/support/nested_shells.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::cube_surface;
using testing::make_set;
using testing::random_volume;
using testing::volume_of;

/// All triangles may stray, nothing is impossible.
std::vector<StrayTriangles> anything(const ShellSet& set) {
  std::vector<StrayTriangles> strays(set.shells.size());
  for (std::size_t k = 0; k < strays.size(); ++k) {
    for (std::uint32_t t = 0; t < set.shells[k].surface.triangles.size(); ++t) {
      strays[k].inwards.push_back(t);
      strays[k].outwards.push_back(t);
    }
    strays[k].lo = 0.0;
    strays[k].hi = 1.0;
  }
  return strays;
}

ShellSet on_a_grid(std::vector<TriangleMesh> surfaces) {
  ShellSet set = make_set(std::move(surfaces));
  constexpr double kStep = 1.0 / 128.0;
  set.grid = QuantizationGrid{glm::dvec3(-2048.0 * kStep), 4095.0 * kStep, 12};
  for (Shell& shell : set.shells) {
    for (glm::vec3& p : shell.surface.positions) {
      p = grid_position(*set.grid, nearest_index(*set.grid, p));
    }
  }
  return set;
}

// A needle through a plate: 16 pairs, as in the tests of CGAL's count.
TEST(Crossings, ANeedleThroughAPlateCrossesSixteenPairs) {
  TriangleMesh plate = cube_surface(1.0F);
  for (glm::vec3& p : plate.positions) p.z *= 0.1F;
  TriangleMesh needle = cube_surface(1.0F);
  for (glm::vec3& p : needle.positions) p = {0.55F + 0.05F * p.x, 0.2F + 0.05F * p.y, 2.0F * p.z};
  const ShellSet set = on_a_grid({plate, needle});
  const auto found = count_crossings(set, anything(set));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].pairs, 16u);
  EXPECT_FALSE(found[0].impossible);
}

TEST(Crossings, NestedAndTouchingSurfacesHaveNone) {
  TriangleMesh inside = cube_surface(0.5F);
  for (glm::vec3& p : inside.positions) p.z += 0.5F;  // its top in the outer one's
  const ShellSet set = on_a_grid({cube_surface(1.0F), {}, inside});
  const auto found = count_crossings(set, anything(set));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].outer, 0u);
  EXPECT_EQ(found[0].inner, 2u);
  EXPECT_EQ(found[0].pairs, 0u);
}

// The same count by CGAL from all triangles, none left out for their emission: what bounds of the
// emission leave out does not cross.
TEST(Crossings, OfNoiseAreThoseThatCgalCounts) {
  BuildOptions options;
  options.levels = uniform_levels(6);
  for (const double tolerance : {0.0, 0.1}) {
    options.emission_tolerance = tolerance;
    const BuiltShells built = build_shells(random_volume<std::uint8_t>({12, 11, 10}, 0, 255, 4),
                                           EmissionMap::window(0, 255), options);
    ASSERT_EQ(built.report.crossings.size(), 5u);
    std::size_t all = 0;
    for (const NeighbourCrossings& pair : built.report.crossings) {
      const MutualIntersections expected = mutual_intersections(
          built.set.shells[pair.outer].surface, built.set.shells[pair.inner].surface);
      EXPECT_EQ(pair.pairs, expected.crossing) << pair.outer;
      all += pair.pairs;
    }
    EXPECT_GT(all, 0u);
  }
}

TEST(Crossings, OfASmoothFieldAreImpossible) {
  const Volume volume = volume_of<float>({32, 32, 32}, [](std::int64_t i, std::int64_t j,
                                                          std::int64_t k) {
    return std::max(0.0, 20.0 - glm::distance(glm::dvec3(i, j, k), glm::dvec3(15.3, 15.6, 15.9)));
  });
  BuildOptions options;
  options.levels = uniform_levels(4);
  const BuiltShells built = build_shells(volume, EmissionMap::window(6, 18), options);
  for (const NeighbourCrossings& pair : built.report.crossings) {
    EXPECT_TRUE(pair.impossible) << pair.outer;
    EXPECT_EQ(pair.pairs, 0u);
  }
}

}  // namespace
}  // namespace nacre

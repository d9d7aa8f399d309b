#include "shells/crossings.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "core/error.h"
#include "core/quantization_grid.h"
#include "shells/border_planes.h"
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

std::vector<NeighbourCrossings> crossings_of(const ShellSet& set) {
  std::vector<std::size_t> shells;
  for (std::size_t k = 0; k < set.shells.size(); ++k) {
    if (!set.shells[k].surface.triangles.empty()) shells.push_back(k);
  }
  return count_neighbour_crossings(
      set, shells, [&](std::size_t k) { return set.shells[k].surface; }, 3);
}

ShellSet on_a_grid(std::vector<TriangleMesh> surfaces) {
  ShellSet set = make_set(std::move(surfaces));
  constexpr double kStep = 1.0 / 128.0;
  set.volume.dims = glm::i64vec3(64);  // far borders
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
  const auto found = crossings_of(set);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].pairs, 16u);
}

// However fine the grid, triangles reach few cells.
TEST(Crossings, OfAFineGridAreTheSame) {
  BuildOptions options;
  options.levels = uniform_levels(3);
  const Volume noise = random_volume<std::uint8_t>({8, 8, 8}, 0, 255, 4);
  for (const int bits : {12, 16, 20}) {
    options.quantization_bits = bits;
    const ShellSet set = build_shells(noise, EmissionMap::window(0, 255), options).set;
    const BorderPlanes border(set);
    for (const NeighbourCrossings& pair : crossings_of(set)) {
      EXPECT_EQ(pair.pairs,
                mutual_intersections(border.without_caps(set.shells[pair.outer].surface),
                                     border.without_caps(set.shells[pair.inner].surface))
                    .crossing);
    }
  }
}

TEST(Crossings, NestedAndTouchingSurfacesHaveNone) {
  TriangleMesh inside = cube_surface(0.5F);
  for (glm::vec3& p : inside.positions) p.z += 0.5F;  // its top in the outer one's
  const ShellSet set = on_a_grid({cube_surface(1.0F), {}, inside});
  const auto found = crossings_of(set);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].outer, 0u);
  EXPECT_EQ(found[0].inner, 2u);
  EXPECT_EQ(found[0].pairs, 0u);
}

TEST(Crossings, AreTheSameForAnyNumberOfSurfacesAtOnce) {
  BuildOptions options;
  options.levels = uniform_levels(9);
  const ShellSet set = build_shells(random_volume<std::uint8_t>({12, 11, 10}, 0, 255, 4),
                                    EmissionMap::window(0, 255), options)
                           .set;
  std::vector<std::size_t> shells(set.shells.size());
  std::iota(shells.begin(), shells.end(), std::size_t{0});
  const auto pairs = [&](std::size_t at_once) {
    std::vector<std::size_t> found;
    const auto surface_of = [&](std::size_t k) { return set.shells[k].surface; };
    for (const auto& c : count_neighbour_crossings(set, shells, surface_of, at_once)) {
      found.insert(found.end(), {c.outer, c.inner, c.pairs});
    }
    return found;
  };
  const auto expected = pairs(1);
  ASSERT_EQ(expected.size(), 3 * 8u);
  for (const std::size_t at_once : {0, 2, 20}) EXPECT_EQ(pairs(at_once), expected);
}

TEST(Crossings, ASurfaceThatCannotBeMadeEndsTheCount) {
  const ShellSet set =
      on_a_grid({cube_surface(1.0F), cube_surface(0.9F), cube_surface(0.8F), cube_surface(0.7F)});
  const std::vector<std::size_t> shells{0, 1, 2, 3};
  for (const std::size_t bad : shells) {
    const auto surface_of = [&](std::size_t k) {
      if (k == bad) throw Error(ErrorCode::BadFile, "damaged");
      return set.shells[k].surface;
    };
    EXPECT_THROW(count_neighbour_crossings(set, shells, surface_of, 3), Error);
  }
}

// Noise has sheets everywhere, and is capped on all sides.
TEST(Crossings, OfNoiseAreThoseThatCgalCounts) {
  BuildOptions options;
  options.levels = uniform_levels(6);
  for (const double tolerance : {0.0, 0.1}) {
    options.emission_tolerance = tolerance;
    const ShellSet set = build_shells(random_volume<std::uint8_t>({12, 11, 10}, 0, 255, 4),
                                      EmissionMap::window(0, 255), options)
                             .set;
    const BorderPlanes border(set);
    const auto found = crossings_of(set);
    ASSERT_EQ(found.size(), 5u);
    std::size_t all = 0;
    for (const NeighbourCrossings& pair : found) {
      const MutualIntersections expected =
          mutual_intersections(border.without_caps(set.shells[pair.outer].surface),
                               border.without_caps(set.shells[pair.inner].surface));
      EXPECT_EQ(pair.pairs, expected.crossing) << pair.outer;
      all += pair.pairs;
    }
    EXPECT_GT(all, 0u);
  }
}

}  // namespace
}  // namespace nacre

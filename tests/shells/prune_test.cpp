#include "shells/prune.h"

#include <gtest/gtest.h>

#include "shells/components.h"
#include "shells/shell_checks.h"
#include "tests/support/analytic_surfaces.h"
#include "tests/support/nested_shells.h"

namespace nacre {
namespace {

using testing::cube_surface;
using testing::make_set;
using testing::moved;
using testing::together;
using testing::torus_surface;
using testing::turned_inside_out;

/// A cube of side 8 with a cavity of side 4, in which an island of side 2 lies, and a speck of side
/// 0.5 outside.
TriangleMesh cheese() {
  TriangleMesh mesh = cube_surface(4.0F, 2);
  mesh = together(std::move(mesh), turned_inside_out(cube_surface(2.0F)));
  mesh = together(std::move(mesh), moved(cube_surface(1.0F), {0.1F, 0.2F, 0.3F}));
  return together(std::move(mesh), moved(cube_surface(0.25F), {6.0F, 0.0F, 0.0F}));
}

TEST(Components, AreCountedAndMeasured) {
  const Components components = find_components(cheese());
  ASSERT_EQ(components.list.size(), 4u);
  EXPECT_EQ(components.list[0].triangles, 48u);
  EXPECT_DOUBLE_EQ(components.list[0].volume_mm3, 512.0);
  EXPECT_DOUBLE_EQ(components.list[1].volume_mm3, -64.0);
  EXPECT_NEAR(components.list[2].volume_mm3, 8.0, 1e-5);
  EXPECT_NEAR(components.list[3].volume_mm3, 0.125, 1e-6);
}

TEST(Components, InsideAnotherAreFound) {
  const TriangleMesh mesh = cheese();
  EXPECT_EQ(inner_components(mesh, find_components(mesh)),
            (std::vector<bool>{false, true, true, false}));
}

// Beside the tube, within its box; a ray along the axis crosses nothing, one through it twice.
TEST(Components, InATorussHoleAreOutside) {
  const TriangleMesh ring = torus_surface(4.0F, 1.0F, 40, 20);
  for (const auto& [offset, inside] : {std::pair(glm::vec3(0.0F), false),
                                       {glm::vec3(4.0F, 0.1F, 0.0F), true},
                                       {glm::vec3(4.0F, 0.1F, -2.0F), false},
                                       {glm::vec3(4.0F, 0.1F, 2.0F), false}}) {
    const TriangleMesh mesh = together(ring, moved(cube_surface(0.3F), offset));
    EXPECT_EQ(inner_components(mesh, find_components(mesh))[1], inside) << offset.x << offset.z;
  }
}

TEST(Prune, LeavesSpecksOut) {
  ShellSet set = make_set({cheese()});
  const Pruning pruned = prune(set, {.min_component_mm3 = 0.2});
  EXPECT_EQ(pruned.specks.components, 1u);
  EXPECT_EQ(pruned.specks.triangles, 12u);
  EXPECT_NEAR(pruned.specks.volume_mm3, 0.125, 1e-6);
  EXPECT_EQ(pruned.inner.components, 0u);
  EXPECT_EQ(pruned.min_component_mm3, 0.2);
  const ShellReport report = check_shell(set.shells[0].surface);
  EXPECT_TRUE(report.is_sound());
  EXPECT_EQ(report.vertices, set.shells[0].surface.positions.size());
  EXPECT_NEAR(report.volume_mm3, 512.0 - 64.0 + 8.0, 1e-4);
}

TEST(Prune, LeavesWhatLiesWithinOut) {
  ShellSet set = make_set({cheese()});
  const Pruning pruned = prune(set, {.prune_inner = true});
  EXPECT_EQ(pruned.inner.components, 2u);
  EXPECT_EQ(pruned.inner.triangles, 24u);
  EXPECT_NEAR(pruned.inner.volume_mm3, 72.0, 1e-4);
  EXPECT_EQ(pruned.largest_emission, 0.0);
  EXPECT_NEAR(check_shell(set.shells[0].surface).volume_mm3, 512.125, 1e-4);
}

TEST(Prune, KeepsEverythingUnlessAsked) {
  ShellSet set = make_set({cheese()});
  const Pruning pruned = prune(set, {});
  EXPECT_EQ(pruned.specks.components + pruned.inner.components, 0u);
  EXPECT_EQ(set.shells[0].surface.triangles.size(), 48u + 3u * 12u);
}

// Representatives 0.25, 0.5, 0.75, 1. One speck on shell 1 loses 0.5 - 0.25; one of shells 1 and 2
// within each other loses 0.75 - 0.25: what shell 0 around both still shows.
TEST(Prune, SaysTheLargestEmissionThatVanishes) {
  const TriangleMesh large = cube_surface(4.0F);
  const TriangleMesh speck = moved(cube_surface(0.25F), {2.0F, 0.0F, 0.0F});
  const TriangleMesh inside = moved(cube_surface(0.2F), {2.0F, 0.0F, 0.0F});
  ShellSet one = make_set({large, speck, {}, {}});
  EXPECT_DOUBLE_EQ(prune(one, {.min_component_mm3 = 1.0}).largest_emission, 0.25);
  ShellSet two = make_set({large, speck, inside, {}});
  EXPECT_DOUBLE_EQ(prune(two, {.min_component_mm3 = 1.0}).largest_emission, 0.5);
  ShellSet all = make_set({speck, inside, {}, {}});
  EXPECT_DOUBLE_EQ(prune(all, {.min_component_mm3 = 1.0}).largest_emission, 0.5);
}

}  // namespace
}  // namespace nacre

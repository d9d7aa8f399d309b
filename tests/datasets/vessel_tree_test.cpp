#include "datasets/vessel_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace nacre {
namespace {

constexpr double kRounding = 1e-12;

/// A root, a bifurcation at node 1, and on one side another one.
std::vector<VesselNode> twice_branched() {
  return {{{0, 0, 0}, -1}, {{0, 0, 1}, 0}, {{1, 0, 2}, 1},
          {{-1, 0, 2}, 1}, {{2, 0, 3}, 2}, {{0, 0, 3}, 2}};
}

TEST(AssignRadii, FollowsMurraysLaw) {
  std::vector<VesselNode> nodes = twice_branched();
  assign_radii(nodes, 0.5);
  EXPECT_NEAR(nodes[5].radius_mm, 0.5, kRounding);
  EXPECT_NEAR(nodes[2].radius_mm, 0.5 * std::cbrt(2.0), kRounding);
  EXPECT_NEAR(nodes[1].radius_mm, 0.5 * std::cbrt(3.0), kRounding);
  EXPECT_NEAR(nodes[0].radius_mm, nodes[1].radius_mm, kRounding);
}

TEST(MainChildren, LeadToMostTips) {
  EXPECT_EQ(main_children(twice_branched()), (std::vector<std::int32_t>{1, 2, 4, -1, -1, -1}));
  EXPECT_EQ(child_counts(twice_branched()), (std::vector<int>{1, 2, 2, 0, 0, 0}));
}

TEST(GrowVessels, FeedsEveryTargetFromOneSprout) {
  std::vector<VesselNode> nodes{{{0, 0, -1}, -1}, {{0, 0, 0}, 0}};
  const std::array targets{glm::dvec3(10, 1, 20), glm::dvec3(-10, 0, 20), glm::dvec3(0, 9, 25)};
  const GrowthOptions options;
  grow_vessels(nodes, std::array{1}, targets, options);
  for (const glm::dvec3& target : targets) {
    const bool fed = std::ranges::any_of(nodes, [&](const VesselNode& node) {
      return glm::distance(node.p_mm, target) < options.reach_mm;
    });
    EXPECT_TRUE(fed) << target.x;
  }
  for (std::size_t i = 2; i < nodes.size(); ++i) {
    const auto parent = static_cast<std::size_t>(nodes[i].parent);
    ASSERT_LT(parent, i);
    EXPECT_NEAR(glm::distance(nodes[i].p_mm, nodes[parent].p_mm), options.step_mm, kRounding);
  }
}

// Two targets straight across from each other pull in opposite directions: no way to grow, but an
// end to it.
TEST(GrowVessels, GivesUpWhereThePullsCancel) {
  std::vector<VesselNode> nodes{{{0, 0, 0}, -1}};
  grow_vessels(nodes, std::array{0}, std::array{glm::dvec3(9, 0, 0), glm::dvec3(-9, 0, 0)}, {});
  EXPECT_EQ(nodes.size(), 1u);
}

TEST(SmoothVessels, RoundsCornersAndKeepsTips) {
  std::vector<VesselNode> nodes{{{0, 0, 0}, -1}, {{1, 1, 0}, 0}, {{2, 0, 0}, 1}};
  smooth_vessels(nodes, 1, 1);
  EXPECT_EQ(nodes[1].p_mm, glm::dvec3(1, 0.5, 0));
  EXPECT_EQ(nodes[2].p_mm, glm::dvec3(2, 0, 0));
}

TEST(VesselSegments, SideBranchesKeepTheirOwnRadius) {
  VesselTree tree{.nodes = twice_branched(), .bridges = {}, .sac = {}};
  assign_radii(tree.nodes, 0.5);
  const std::vector<VesselSegment> segments = vessel_segments(tree);
  ASSERT_EQ(segments.size(), 5u);
  EXPECT_EQ(segments[1].from_radius_mm, tree.nodes[1].radius_mm);  // to node 2, the main branch
  EXPECT_EQ(segments[2].from_radius_mm, tree.nodes[3].radius_mm);  // to node 3
}

}  // namespace
}  // namespace nacre

#include "datasets/cerebral_arteries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <set>

#include "datasets/angiogram.h"

namespace nacre {
namespace {

constexpr double kRounding = 1e-12;

/// The arteries of seed 1, grown once for all tests.
const VesselTree& arteries() {
  static const VesselTree tree = make_cerebral_arteries(1);
  return tree;
}

TEST(CerebralArteries, FollowMurraysLawAtEveryNode) {
  const std::vector<VesselNode>& nodes = arteries().nodes;
  std::vector<double> children_cubed(nodes.size(), 0.0);
  for (const VesselNode& node : nodes) {
    if (node.parent < 0) continue;
    children_cubed[static_cast<std::size_t>(node.parent)] += std::pow(node.radius_mm, 3);
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double expected = children_cubed[i] > 0.0 ? children_cubed[i] : std::pow(kTipRadiusMm, 3);
    ASSERT_NEAR(std::pow(nodes[i].radius_mm, 3) / expected, 1.0, 10 * kRounding);
  }
}

TEST(CerebralArteries, HaveFiveEntriesAndHundredsOfTips) {
  const std::vector<VesselNode>& nodes = arteries().nodes;
  const auto roots = std::ranges::count(nodes, -1, &VesselNode::parent);
  EXPECT_EQ(roots, 5);  // carotids, basilar, temporal arteries
  const std::vector<int> children = child_counts(nodes);
  EXPECT_GT(std::ranges::count(children, 0), 500);
  EXPECT_GT(std::ranges::count_if(children, [](int count) { return count > 1; }), 400);
}

TEST(CerebralArteries, HaveRadiiOfArteries) {
  for (const VesselNode& node : arteries().nodes) {
    ASSERT_GE(node.radius_mm, kTipRadiusMm * (1.0 - kRounding));
    ASSERT_LE(node.radius_mm, 2.5);
  }
}

/// Which ends of segments are one point: each point's component, by union-find.
class Components {
 public:
  void join(const glm::dvec3& a, const glm::dvec3& b) { parent_[root(place(a))] = root(place(b)); }

  std::size_t count() {
    std::set<std::size_t> roots;
    for (std::size_t i = 0; i < parent_.size(); ++i) roots.insert(root(i));
    return roots.size();
  }

 private:
  std::size_t place(const glm::dvec3& p) {
    const std::array key{std::llround(p.x * 1e6), std::llround(p.y * 1e6), std::llround(p.z * 1e6)};
    const auto [found, is_new] = places_.try_emplace(key, parent_.size());
    if (is_new) parent_.push_back(found->second);
    return found->second;
  }

  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  std::map<std::array<long long, 3>, std::size_t> places_;
  std::vector<std::size_t> parent_;
};

TEST(CerebralArteries, FormOneNetworkBesideTheTwoOfTheScalp) {
  VesselTree vessels = arteries();
  vessels.sac.clear();  // overlaps its bifurcation, without sharing points
  Components components;
  for (const VesselSegment& segment : vessel_segments(vessels)) {
    components.join(segment.from_mm, segment.to_mm);
  }
  EXPECT_EQ(components.count(), 3u);
}

TEST(CerebralArteries, CarryAnAneurysmOnABifurcation) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const VesselTree tree = make_cerebral_arteries(seed);
    ASSERT_FALSE(tree.sac.empty());
    const auto carrier = std::ranges::find(tree.nodes, tree.sac.front().from_mm, &VesselNode::p_mm);
    ASSERT_NE(carrier, tree.nodes.end());
    const auto place = static_cast<std::size_t>(carrier - tree.nodes.begin());
    EXPECT_GE(child_counts(tree.nodes)[place], 2);
    EXPECT_GT(tree.sac[1].to_radius_mm, 3.4);
    EXPECT_LT(tree.sac[1].to_radius_mm, 4.9);
  }
}

TEST(CerebralArteries, LieInTheFieldOfViewExceptWhereTheyEnter) {
  for (const VesselNode& node : arteries().nodes) {
    EXPECT_LT(std::abs(node.p_mm.x), 0.5 * kAngiogramExtentMm.x);
    EXPECT_LT(std::abs(node.p_mm.y), 0.5 * kAngiogramExtentMm.y);
    EXPECT_LT(node.p_mm.z, 0.5 * kAngiogramExtentMm.z);
  }
}

}  // namespace
}  // namespace nacre

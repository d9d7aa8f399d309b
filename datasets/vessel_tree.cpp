#include "datasets/vessel_tree.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "datasets/portable_math.h"

namespace nacre {
namespace {

std::size_t index(std::int32_t node) { return static_cast<std::size_t>(node); }

double distance_squared(const glm::dvec3& a, const glm::dvec3& b) {
  const double x = a.x - b.x;
  const double y = a.y - b.y;
  const double z = a.z - b.z;
  return x * x + y * y + z * z;
}

/// A point to feed, and the node that is nearest to it so far.
struct Target {
  glm::dvec3 p_mm;
  std::size_t nearest;
  double distance_squared_mm2;
};

/// How often a node has put out a step, and where the last one went.
struct Bud {
  int steps = 0;
  glm::dvec3 last_mm{0.0};
};

constexpr int kMostSteps = 2;  // vessels bifurcate

/// The targets, each with the sprout that is nearest to it.
std::vector<Target> nearest_sprouts(std::span<const VesselNode> nodes,
                                    std::span<const std::int32_t> sprouts,
                                    std::span<const glm::dvec3> points) {
  std::vector<Target> targets;
  targets.reserve(points.size());
  for (const glm::dvec3& p_mm : points) {
    Target target{p_mm, 0, std::numeric_limits<double>::infinity()};
    for (const std::int32_t sprout : sprouts) {
      const double squared = distance_squared(p_mm, nodes[index(sprout)].p_mm);
      if (squared < target.distance_squared_mm2) target = {p_mm, index(sprout), squared};
    }
    targets.push_back(target);
  }
  return targets;
}

/// Number of tips downstream of every node.
std::vector<int> tip_counts(std::span<const VesselNode> nodes) {
  std::vector<int> tips(nodes.size(), 0);
  for (std::size_t i = nodes.size(); i-- > 0;) {
    tips[i] = std::max(tips[i], 1);
    if (nodes[i].parent >= 0) tips[index(nodes[i].parent)] += tips[i];
  }
  return tips;
}

/// Lets the nodes from `first` on claim the targets they are nearest to, and drops the fed ones.
void claim_targets(std::vector<Target>& targets, std::span<const VesselNode> nodes,
                   std::size_t first, double reach_mm) {
  for (Target& target : targets) {
    for (std::size_t i = first; i < nodes.size(); ++i) {
      const double squared = distance_squared(target.p_mm, nodes[i].p_mm);
      if (squared < target.distance_squared_mm2) target = {target.p_mm, i, squared};
    }
  }
  std::erase_if(targets, [&](const Target& target) {
    return target.distance_squared_mm2 < reach_mm * reach_mm;
  });
}

/// Sum of the unit vectors from every node to the targets that pull at it.
std::vector<glm::dvec3> pulls(std::span<const Target> targets, std::span<const VesselNode> nodes) {
  std::vector<glm::dvec3> pull(nodes.size(), glm::dvec3(0.0));
  for (const Target& target : targets) {
    pull[target.nearest] += glm::normalize(target.p_mm - nodes[target.nearest].p_mm);
  }
  return pull;
}

/// One step from a node along its pull and the way so far.
glm::dvec3 stepped(std::span<const VesselNode> nodes, std::size_t from, const glm::dvec3& pull,
                   const GrowthOptions& options) {
  const VesselNode& node = nodes[from];
  glm::dvec3 direction = glm::normalize(pull);
  if (node.parent >= 0) {
    const glm::dvec3 way = node.p_mm - nodes[index(node.parent)].p_mm;
    const double length = glm::length(way);
    if (length > 0.0) direction = glm::normalize(direction + options.inertia / length * way);
  }
  return node.p_mm + options.step_mm * direction;
}

}  // namespace

std::vector<int> child_counts(std::span<const VesselNode> nodes) {
  std::vector<int> counts(nodes.size(), 0);
  for (const VesselNode& node : nodes) {
    if (node.parent >= 0) ++counts[index(node.parent)];
  }
  return counts;
}

std::vector<std::int32_t> main_children(std::span<const VesselNode> nodes) {
  const std::vector<int> tips = tip_counts(nodes);
  std::vector<std::int32_t> child(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent < 0) continue;
    std::int32_t& best = child[index(nodes[i].parent)];
    if (best < 0 || tips[i] > tips[index(best)]) best = static_cast<std::int32_t>(i);
  }
  return child;
}

void assign_radii(std::span<VesselNode> nodes, double tip_radius_mm) {
  std::vector<double> cubes(nodes.size(), 0.0);
  const double tip_cube = tip_radius_mm * tip_radius_mm * tip_radius_mm;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    if (cubes[i] == 0.0) cubes[i] = tip_cube;
    nodes[i].radius_mm = portable_cbrt(cubes[i]);
    if (nodes[i].parent >= 0) cubes[index(nodes[i].parent)] += cubes[i];
  }
}

void grow_vessels(std::vector<VesselNode>& nodes, std::span<const std::int32_t> sprouts,
                  std::span<const glm::dvec3> target_points, const GrowthOptions& options) {
  std::vector<Target> targets = nearest_sprouts(nodes, sprouts, target_points);
  std::vector<Bud> buds(nodes.size());
  while (!targets.empty()) {
    const std::vector<glm::dvec3> pull = pulls(targets, nodes);
    const std::size_t grown_before = nodes.size();
    for (std::size_t from = 0; from < grown_before; ++from) {
      if (pull[from] == glm::dvec3(0.0) || buds[from].steps == kMostSteps) continue;
      const glm::dvec3 p_mm = stepped(nodes, from, pull[from], options);
      const bool repeats =
          buds[from].steps > 0 && glm::distance(p_mm, buds[from].last_mm) < 0.5 * options.step_mm;
      // Targets that would make it step there again stay unfed: nothing nearer can come of it.
      buds[from] = {repeats ? kMostSteps : buds[from].steps + 1, p_mm};
      if (!repeats) nodes.push_back({p_mm, static_cast<std::int32_t>(from)});
    }
    if (nodes.size() == grown_before) break;
    buds.resize(nodes.size());
    claim_targets(targets, nodes, grown_before, options.reach_mm);
  }
}

void smooth_vessels(std::span<VesselNode> nodes, std::size_t first, int passes) {
  const std::vector<std::int32_t> child = main_children(nodes);
  std::vector<glm::dvec3> smoothed(nodes.size());
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t i = first; i < nodes.size(); ++i) {
      smoothed[i] = nodes[i].p_mm;
      if (nodes[i].parent < 0 || child[i] < 0) continue;
      const glm::dvec3 ends = nodes[index(nodes[i].parent)].p_mm + nodes[index(child[i])].p_mm;
      smoothed[i] = 0.5 * nodes[i].p_mm + 0.25 * ends;
    }
    for (std::size_t i = first; i < nodes.size(); ++i) nodes[i].p_mm = smoothed[i];
  }
}

std::vector<VesselSegment> vessel_segments(const VesselTree& tree) {
  const std::vector<std::int32_t> child = main_children(tree.nodes);
  std::vector<VesselSegment> segments;
  segments.reserve(tree.nodes.size() + tree.bridges.size() + tree.sac.size());
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const VesselNode& node = tree.nodes[i];
    if (node.parent < 0) continue;
    const VesselNode& parent = tree.nodes[index(node.parent)];
    const bool is_main = index(child[index(node.parent)]) == i;
    const double from_radius_mm = is_main ? parent.radius_mm : node.radius_mm;
    segments.push_back({parent.p_mm, node.p_mm, from_radius_mm, node.radius_mm});
  }
  segments.insert(segments.end(), tree.bridges.begin(), tree.bridges.end());
  segments.insert(segments.end(), tree.sac.begin(), tree.sac.end());
  return segments;
}

}  // namespace nacre

#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace nacre {

/// A point of a vessel's centre line.
struct VesselNode {
  glm::dvec3 p_mm;
  std::int32_t parent = -1;  ///< upstream, an index below this node's own; -1 where blood enters
  double radius_mm = 0.0;    ///< see assign_radii()
};

/// A round cone: the balls of linearly varying radius along a line.
struct VesselSegment {
  glm::dvec3 from_mm;
  glm::dvec3 to_mm;
  double from_radius_mm;
  double to_radius_mm;
};

/// Vessels: trees that branch, and what joins them into a network.
struct VesselTree {
  std::vector<VesselNode> nodes;       ///< parents before children
  std::vector<VesselSegment> bridges;  ///< outside the trees: communicating and confluent vessels
  std::vector<VesselSegment> sac;      ///< the aneurysm: its neck first
};

/// Number of children of every node.
std::vector<int> child_counts(std::span<const VesselNode> nodes);

/// For every node the child that carries most blood (first of equals), or -1 at a tip.
std::vector<std::int32_t> main_children(std::span<const VesselNode> nodes);

/// Radii by Murray's law (Murray 1926, "The physiological principle of minimum work"): the work of
/// moving and keeping blood is least where the flow goes with the radius cubed
/// (docs/derivations.md, P8), so that
///
///     r_parent^3 = sum of r_child^3
///
/// at every branching, and the radius is constant between branchings.
///
/// @param tip_radius_mm  of the nodes without children
void assign_radii(std::span<VesselNode> nodes, double tip_radius_mm);

/// How vessels grow towards the tissue they feed.
struct GrowthOptions {
  double step_mm = 1.0;
  double reach_mm = 2.2;  ///< a target this near to a node is fed
  double inertia = 0.7;   ///< weight of the way so far against the pull of the targets
};

/// Grows branches towards targets by space colonisation (Runions, Lane, Prusinkiewicz 2007,
/// "Modeling trees with a space colonization algorithm"): each target pulls at the nearest node; a
/// pulled node puts out a step in the mean direction of its targets; fed targets are taken away.
///
/// @param sprouts  indices of the nodes that may put out branches
/// @param targets  points to feed, mm
/// Cost: (targets) * (nodes grown).
void grow_vessels(std::vector<VesselNode>& nodes, std::span<const std::int32_t> sprouts,
                  std::span<const glm::dvec3> targets, const GrowthOptions& options);

/// Rounds the corners of the nodes from `first` on: each moves half way to the middle between its
/// parent and its main child, `passes` times. Tips stay.
void smooth_vessels(std::span<VesselNode> nodes, std::size_t first, int passes);

/// Everything to draw: a cone for each node's way from its parent, the bridges and the sac. A side
/// branch keeps its own radius up to the parent's centre line; the main branch tapers from the
/// parent's.
std::vector<VesselSegment> vessel_segments(const VesselTree& tree);

}  // namespace nacre

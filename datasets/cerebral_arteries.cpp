#include "datasets/cerebral_arteries.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <string_view>
#include <utility>

#include "datasets/head_anatomy.h"
#include "datasets/portable_math.h"
#include "datasets/random.h"

namespace nacre {
namespace {

constexpr double kStepMm = 1.0;
constexpr double kLeft = 1.0;
constexpr double kRight = -1.0;

/// Seeds of the displacement fields, far from each other.
constexpr std::uint64_t kTortuositySalt = 0x746f7274;

/// The arteries while they grow, and which node belongs to which.
struct Arteries {
  std::vector<VesselNode> nodes;
  /// Nodes of each trunk from its root on, by name and side.
  std::map<std::pair<std::string_view, double>, std::vector<std::int32_t>> trunks;

  const std::vector<std::int32_t>& trunk(std::string_view name, double side) const {
    const auto found = trunks.find({name, side});
    return found != trunks.end() ? found->second : trunks.at({name, kLeft});
  }
};

glm::dvec3 on_side(const glm::dvec3& p_mm, double side) { return {side * p_mm.x, p_mm.y, p_mm.z}; }

/// The cubic from p[1] to p[2], u in [0, 1], whose tangents follow p[0] and p[3] (Catmull and Rom
/// 1974).
glm::dvec3 spline(const std::array<glm::dvec3, 4>& p, double u) {
  const glm::dvec3 linear = p[2] - p[0];
  const glm::dvec3 square = 2.0 * p[0] - 5.0 * p[1] + 4.0 * p[2] - p[3];
  const glm::dvec3 cubic = 3.0 * (p[1] - p[2]) + p[3] - p[0];
  return p[1] + 0.5 * u * (linear + u * (square + u * cubic));
}

/// A curve through control points in steps of about kStepMm, without its first point.
std::vector<glm::dvec3> curve_through(std::span<const glm::dvec3> controls) {
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i + 1 < controls.size(); ++i) {
    const std::array window{controls[i > 0 ? i - 1 : 0], controls[i], controls[i + 1],
                            controls[std::min(i + 2, controls.size() - 1)]};
    const double length = glm::distance(window[1], window[2]);
    const int steps = std::max(1, static_cast<int>(std::lround(length / kStepMm)));
    for (int step = 1; step <= steps; ++step) {
      points.push_back(spline(window, static_cast<double>(step) / steps));
    }
  }
  return points;
}

std::int32_t nearest_node(const Arteries& arteries, const std::vector<std::int32_t>& among,
                          const glm::dvec3& p_mm) {
  const auto distance = [&](std::int32_t node) {
    return glm::distance(arteries.nodes[static_cast<std::size_t>(node)].p_mm, p_mm);
  };
  return *std::min_element(among.begin(), among.end(), [&](std::int32_t a, std::int32_t b) {
    return distance(a) < distance(b);
  });
}

/// The trunk's control points on one side, each moved a little.
std::vector<glm::dvec3> moved_controls(const Trunk& trunk, double side, RandomSequence& random) {
  constexpr double reach_mm = 0.8;
  std::vector<glm::dvec3> controls;
  for (const glm::dvec3& control_mm : trunk.controls_mm) {
    glm::dvec3 move;
    for (int axis = 0; axis < 3; ++axis) move[axis] = random.uniform(-reach_mm, reach_mm);
    controls.push_back(on_side(control_mm, side) + move);
    if (trunk.feeds == Territory::Scalp) {
      controls.back() = BrainShape{}.at_scale(controls.back(), kScalpScale);
    }
  }
  return controls;
}

/// Where a trunk leaves its parent: its end where the anatomy says so, else the nearest node.
std::int32_t branching_node(const Arteries& arteries, std::span<const Trunk> trunks,
                            const Trunk& trunk, double side, const glm::dvec3& start_mm) {
  const std::vector<std::int32_t>& nodes = arteries.trunk(trunk.parent, side);
  const auto parent = std::ranges::find(trunks, trunk.parent, &Trunk::name);
  assert(parent != trunks.end());
  if (parent->controls_mm.back() == trunk.controls_mm.front()) return nodes.back();
  return nearest_node(arteries, nodes, start_mm);
}

void add_trunk(Arteries& arteries, std::span<const Trunk> trunks, const Trunk& trunk, double side,
               RandomSequence& random) {
  std::vector<glm::dvec3> controls = moved_controls(trunk, side, random);
  std::vector<std::int32_t>& own = arteries.trunks[{trunk.name, side}];
  if (trunk.parent.empty()) {
    arteries.nodes.push_back({controls.front()});
    own.push_back(static_cast<std::int32_t>(arteries.nodes.size()) - 1);
  } else {
    own.push_back(branching_node(arteries, trunks, trunk, side, controls.front()));
    controls.front() = arteries.nodes[static_cast<std::size_t>(own.front())].p_mm;
  }
  for (const glm::dvec3& p_mm : curve_through(controls)) {
    arteries.nodes.push_back({p_mm, own.back()});
    own.push_back(static_cast<std::int32_t>(arteries.nodes.size()) - 1);
  }
}

/// The nodes from which a territory's branches may leave its trunks: one in five, and the ends.
std::vector<std::int32_t> sprouts_of(const Arteries& arteries, std::span<const Trunk> trunks,
                                     Territory territory, double side) {
  constexpr std::size_t spacing = 5;
  std::vector<std::int32_t> sprouts;
  for (const Trunk& trunk : trunks) {
    if (trunk.feeds != territory) continue;
    const std::vector<std::int32_t>& nodes = arteries.trunk(trunk.name, side);
    for (std::size_t i = spacing; i + 1 < nodes.size(); i += spacing) sprouts.push_back(nodes[i]);
    if (territory != Territory::Perforators) sprouts.push_back(nodes.back());
  }
  return sprouts;
}

void grow_territory(Arteries& arteries, std::span<const Trunk> trunks,
                    const TerritorySupply& supply, double side, RandomSequence& random) {
  std::vector<glm::dvec3> targets = territory_targets(supply, random);
  for (glm::dvec3& p_mm : targets) p_mm = on_side(p_mm, side);
  const std::size_t first = arteries.nodes.size();
  grow_vessels(arteries.nodes, sprouts_of(arteries, trunks, supply.territory, side), targets,
               {.step_mm = kStepMm});
  smooth_vessels(arteries.nodes, first, 4);
  if (supply.territory != Territory::Scalp) return;
  for (std::size_t i = first; i < arteries.nodes.size(); ++i) {
    arteries.nodes[i].p_mm = BrainShape{}.at_scale(arteries.nodes[i].p_mm, kScalpScale);
  }
}

/// Smooth random displacement on three scales, about 3 mm in all: anatomy that differs between the
/// sides, and the tortuosity of the vessels.
glm::dvec3 displaced(const glm::dvec3& p_mm, std::uint64_t seed) {
  struct Scale {
    double lattice_mm;
    double amplitude_mm;
  };
  constexpr std::array<Scale, 3> scales{{{24.0, 3.2}, {9.0, 2.2}, {3.6, 0.9}}};
  glm::dvec3 moved = p_mm;
  std::uint64_t field = kTortuositySalt;
  for (const Scale& scale : scales) {
    for (int axis = 0; axis < 3; ++axis) {
      const double noise = smooth_noise(random_bits(seed, ++field), p_mm / scale.lattice_mm);
      moved[axis] += scale.amplitude_mm * noise;
    }
  }
  return moved;
}

/// A bridge through control points, its radius constant.
void add_bridge(VesselTree& tree, std::span<const glm::dvec3> controls, double radius_mm,
                std::uint64_t seed) {
  glm::dvec3 from_mm = displaced(controls.front(), seed);
  for (const glm::dvec3& p_mm : curve_through(controls)) {
    const glm::dvec3 to_mm = displaced(p_mm, seed);
    tree.bridges.push_back({from_mm, to_mm, radius_mm, radius_mm});
    from_mm = to_mm;
  }
}

/// The communicating arteries, which close the circle of Willis, and the vertebral ones, which
/// share the basilar's blood 3 to 2. Nodes are not displaced yet.
void add_bridges(VesselTree& tree, const Arteries& arteries, std::uint64_t seed) {
  const auto node = [&](std::string_view trunk, double side, const glm::dvec3& near_mm) {
    const std::int32_t found =
        nearest_node(arteries, arteries.trunk(trunk, side), on_side(near_mm, side));
    return arteries.nodes[static_cast<std::size_t>(found)].p_mm;
  };
  const std::int32_t junction = arteries.trunk("basilar", kLeft).front();
  const glm::dvec3 confluence_mm = arteries.nodes[static_cast<std::size_t>(junction)].p_mm;
  const double basilar_radius_mm = tree.nodes[static_cast<std::size_t>(junction)].radius_mm;
  for (const double side : {kLeft, kRight}) {
    const std::array communicating{node("internal carotid", side, {11, -11, -21.5}),
                                   on_side({12, -4, -23}, side), on_side({12, 3, -24}, side),
                                   node("P1", side, {10, 9, -24})};
    add_bridge(tree, communicating, 0.55, seed);
    const std::array vertebral{on_side({15, 23, -56}, side), on_side({11, 21, -51}, side),
                               on_side({5, 17, -46}, side), confluence_mm};
    add_bridge(tree, vertebral, basilar_radius_mm * portable_cbrt(side == kLeft ? 0.6 : 0.4), seed);
  }
  const std::array anterior{node("A1", kLeft, {3, -18, -19.5}),
                            node("A1", kRight, {3, -18, -19.5})};
  add_bridge(tree, anterior, 0.8, seed);
}

/// An aneurysm where `trunk` ends and divides: a neck, an oblong sac and a bleb upon it.
void add_aneurysm(VesselTree& tree, std::span<const std::int32_t> trunk, RandomSequence& random) {
  const auto node = [&](std::size_t from_end) {
    return tree.nodes[static_cast<std::size_t>(trunk[trunk.size() - 1 - from_end])];
  };
  const VesselNode end = node(0);
  glm::dvec3 lean;
  for (int axis = 0; axis < 3; ++axis) lean[axis] = random.uniform(-0.4, 0.4);
  // The jet that dilates it goes straight on from the parent vessel.
  const glm::dvec3 axis = glm::normalize(glm::normalize(end.p_mm - node(5).p_mm) + lean);
  const double radius_mm = random.uniform(3.5, 4.8);
  const glm::dvec3 center_mm = end.p_mm + axis * (radius_mm + 0.6 * end.radius_mm);
  const glm::dvec3 half_mm = axis * (0.3 * radius_mm);
  const glm::dvec3 bleb_mm = center_mm + glm::normalize(axis + 2.0 * lean) * (0.95 * radius_mm);
  tree.sac = {{end.p_mm, center_mm, 1.1 * end.radius_mm, 0.7 * radius_mm},
              {center_mm - half_mm, center_mm + half_mm, 0.9 * radius_mm, radius_mm},
              {center_mm, bleb_mm, 0.5 * radius_mm, 0.45 * radius_mm}};
}

}  // namespace

VesselTree make_cerebral_arteries(std::uint64_t seed) {
  RandomSequence random(seed);
  const std::vector<Trunk> trunks = cerebral_trunks();
  Arteries arteries;
  for (const Trunk& trunk : trunks) {
    add_trunk(arteries, trunks, trunk, kLeft, random);
    if (!trunk.midline) add_trunk(arteries, trunks, trunk, kRight, random);
  }
  for (const TerritorySupply& supply : territory_supplies()) {
    for (const double side : {kLeft, kRight}) {
      grow_territory(arteries, trunks, supply, side, random);
    }
  }
  VesselTree tree;
  assign_radii(arteries.nodes, kTipRadiusMm);
  tree.nodes = arteries.nodes;
  for (VesselNode& node : tree.nodes) node.p_mm = displaced(node.p_mm, seed);
  add_bridges(tree, arteries, seed);
  const int place = static_cast<int>(random.uniform(0.0, 3.0));
  const std::vector<std::int32_t>& carrier =
      place == 0 ? arteries.trunk("basilar", kLeft)
                 : arteries.trunk("M1", place == 1 ? kLeft : kRight);
  add_aneurysm(tree, carrier, random);
  return tree;
}

}  // namespace nacre

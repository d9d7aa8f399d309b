#include "datasets/head_anatomy.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>

namespace nacre {
namespace {

std::vector<Trunk> anterior_trunks() {
  return {
      {.name = "internal carotid",
       .parent = "",
       .controls_mm = {{26, 13, -54},
                       {27, 10, -47},
                       {25, 5, -41},
                       {20, 0, -38},
                       {14, -2, -37},
                       {11, -6, -34},
                       {11, -13, -32},
                       {11, -18, -29},
                       {11.5, -18.5, -25},
                       {11, -13.5, -22.5},
                       {11, -9, -20.5}}},
      {.name = "M1",
       .parent = "internal carotid",
       .feeds = Territory::Perforators,
       .controls_mm = {{11, -9, -20.5}, {17, -10, -19}, {24, -10.5, -19.5}, {31, -9, -20}}},
      {.name = "M2 superior",
       .parent = "M1",
       .feeds = Territory::Middle,
       .controls_mm =
           {{31, -9, -20}, {36, -8, -14}, {39, -4, -5}, {41, 2, 3}, {46, 6, 8}, {54, 10, 12}}},
      {.name = "M2 anterior",
       .parent = "M2 superior",
       .feeds = Territory::Middle,
       .controls_mm = {{37, -7, -11}, {40, -14, 0}, {44, -24, 6}, {47, -34, 12}}},
      {.name = "M2 inferior",
       .parent = "M1",
       .feeds = Territory::Middle,
       .controls_mm =
           {{31, -9, -20}, {36, -5, -17}, {40, 3, -12}, {43, 12, -6}, {48, 22, 0}, {54, 32, 4}}},
      {.name = "A1",
       .parent = "internal carotid",
       .controls_mm = {{11, -9, -20.5}, {8, -13, -19.5}, {3, -18, -19.5}}},
      {.name = "A2",
       .parent = "A1",
       .feeds = Territory::Anterior,
       .controls_mm = {{3, -18, -19.5},
                       {2, -24, -14},
                       {2, -33, -4},
                       {2, -37, 7},
                       {2, -33, 18},
                       {2.2, -22, 25},
                       {2.2, -6, 28},
                       {2.5, 12, 28},
                       {3, 26, 24}}},
      {.name = "callosomarginal",
       .parent = "A2",
       .feeds = Territory::Anterior,
       .controls_mm = {{2, -37, 7},
                       {3, -46, 14},
                       {3, -46, 26},
                       {3.5, -34, 36},
                       {4, -16, 41},
                       {4, 2, 42},
                       {4, 18, 40}}},
  };
}

std::vector<Trunk> posterior_trunks() {
  return {
      {.name = "basilar",
       .parent = "",
       .midline = true,
       .controls_mm = {{0, 13, -41}, {0.7, 10, -35}, {-0.5, 8.5, -30}, {0, 8, -25}}},
      {.name = "P1",
       .parent = "basilar",
       .feeds = Territory::Posterior,
       .controls_mm = {{0, 8, -25},
                       {5, 7, -24.5},
                       {11, 9, -24},
                       {17, 15, -23},
                       {19, 24, -21},
                       {17, 33, -19},
                       {15, 42, -17},
                       {12, 52, -15},
                       {10, 62, -12}}},
      {.name = "parieto-occipital",
       .parent = "P1",
       .feeds = Territory::Posterior,
       .controls_mm = {{17, 33, -19}, {14, 44, -10}, {11, 54, -2}, {10, 62, 6}}},
      {.name = "posterior temporal",
       .parent = "P1",
       .feeds = Territory::Posterior,
       .controls_mm = {{19, 24, -21}, {28, 28, -24}, {38, 32, -24}, {44, 40, -22}}},
      {.name = "superior cerebellar",
       .parent = "basilar",
       .feeds = Territory::Cerebellum,
       .controls_mm =
           {{0, 8, -27}, {6, 10, -29}, {13, 16, -30}, {17, 26, -29}, {16, 36, -28}, {14, 46, -30}}},
      {.name = "inferior cerebellar",
       .parent = "basilar",
       .feeds = Territory::Cerebellum,
       .controls_mm = {{0, 11, -37}, {8, 13, -39}, {18, 19, -41}, {28, 27, -42}}},
  };
}

std::vector<Trunk> scalp_trunks() {
  return {
      {.name = "superficial temporal",
       .parent = "",
       .feeds = Territory::Scalp,
       .controls_mm = {{58, -8, -54},
                       {66, -6, -40},
                       {72, -6, -25},
                       {73, -10, -10},
                       {71, -18, 5},
                       {66, -28, 18}}},
      {.name = "superficial temporal, parietal",
       .parent = "superficial temporal",
       .feeds = Territory::Scalp,
       .controls_mm = {{73, -9, -12}, {72, 2, 4}, {66, 12, 20}, {55, 18, 36}}},
  };
}

/// The shell of the brain's scaled copies in which a territory lies.
struct ScaleRange {
  double lo;
  double hi;
};

ScaleRange scales_of(Territory territory) {
  switch (territory) {
    case Territory::Perforators: return {0.2, 0.5};
    case Territory::Anterior: return {0.74, 0.97};
    case Territory::Cerebellum: return {0.6, 0.95};
    case Territory::Scalp: return {kScalpScale, kScalpScale};
    default: return {0.86, 0.97};
  }
}

/// Whether a point of the territory's shell (LPS mm, x > 0) lies in it.
bool contains(Territory territory, const glm::dvec3& p) {
  switch (territory) {
    case Territory::None: return false;
    case Territory::Perforators:
      return p.x > 17 && p.x < 28 && p.y > -9 && p.y < 8 && p.z > -13 && p.z < 4;
    case Territory::Middle: return p.x > 26 && p.y < 52 && p.z > -26 && !(p.z > 28 && p.x < 34);
    case Territory::Anterior: return p.x < 26 && p.y < 40 && p.z > -10 && (p.y < -30 || p.z > 12);
    case Territory::Posterior: {
      const bool occipital = p.y > 40 && p.x < 45 && p.z > -24 && p.z < 24;
      const bool inferior_temporal = p.x > 20 && p.x < 50 && p.y > 8 && p.z > -32 && p.z < -22;
      return occipital || inferior_temporal;
    }
    case Territory::Cerebellum: return p.x < 46 && p.y > 14 && p.z < -28 && p.z > -49;
    case Territory::Scalp: return p.x > 30 && p.y > -60 && p.y < 50 && p.z > -30 && p.z < 47;
  }
  return false;
}

/// A random point of a territory.
glm::dvec3 candidate(Territory territory, RandomSequence& random) {
  const BrainShape brain;
  const ScaleRange scales = scales_of(territory);
  while (true) {
    glm::dvec3 direction;
    direction.x = random.uniform(0.0, 1.0);
    direction.y = random.uniform(-1.0, 1.0);
    direction.z = random.uniform(-1.0, 1.0);
    const double length = glm::length(direction);
    const double scale = random.uniform(scales.lo, scales.hi);
    if (length > 1.0 || length < 0.1) continue;
    const glm::dvec3 p_mm = brain.center_mm + brain.semi_axes_mm * direction * (scale / length);
    if (contains(territory, p_mm)) return p_mm;
  }
}

/// Distance from a point to the nearest of others.
double clearance(const glm::dvec3& p, std::span<const glm::dvec3> others) {
  double least = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& other : others) least = std::min(least, glm::distance(p, other));
  return least;
}

}  // namespace

double BrainShape::scale_of(const glm::dvec3& p_mm) const {
  return glm::length((p_mm - center_mm) / semi_axes_mm);
}

glm::dvec3 BrainShape::at_scale(const glm::dvec3& p_mm, double scale) const {
  return center_mm + (p_mm - center_mm) * (scale / scale_of(p_mm));
}

std::vector<Trunk> cerebral_trunks() {
  std::vector<Trunk> trunks = anterior_trunks();
  for (auto& more : {posterior_trunks(), scalp_trunks()}) {
    trunks.insert(trunks.end(), more.begin(), more.end());
  }
  return trunks;
}

std::span<const TerritorySupply> territory_supplies() {
  static constexpr std::array<TerritorySupply, 6> supplies{{{Territory::Perforators, 8},
                                                            {Territory::Middle, 180},
                                                            {Territory::Anterior, 90},
                                                            {Territory::Posterior, 75},
                                                            {Territory::Cerebellum, 50},
                                                            {Territory::Scalp, 20}}};
  return supplies;
}

std::vector<glm::dvec3> territory_targets(const TerritorySupply& supply, RandomSequence& random) {
  constexpr int candidates = 8;
  std::vector<glm::dvec3> targets;
  while (targets.size() < static_cast<std::size_t>(supply.targets)) {
    glm::dvec3 best = candidate(supply.territory, random);
    for (int i = 1; i < candidates; ++i) {
      const glm::dvec3 other = candidate(supply.territory, random);
      if (clearance(other, targets) > clearance(best, targets)) best = other;
    }
    targets.push_back(best);
  }
  return targets;
}

}  // namespace nacre

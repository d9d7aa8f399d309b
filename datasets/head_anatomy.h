#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "datasets/random.h"

namespace nacre {

/// The ellipsoid of the model's brain, |(p - center) / semi_axes| = 1, in LPS mm. Skull and scalp
/// are scaled copies of it.
struct BrainShape {
  glm::dvec3 center_mm{0.0, 2.0, -12.0};
  glm::dvec3 semi_axes_mm{64.0, 78.0, 58.0};

  /// How many times the brain's own size the copy through p has.
  double scale_of(const glm::dvec3& p_mm) const;

  /// The point in the same direction from the centre on the copy of that scale.
  glm::dvec3 at_scale(const glm::dvec3& p_mm, double scale) const;
};

/// Scale of the copy of the brain's surface in which the arteries of the scalp run.
inline constexpr double kScalpScale = 1.155;

/// The tissue that an artery's branches feed.
enum class Territory { None, Perforators, Middle, Anterior, Posterior, Cerebellum, Scalp };

/// An artery of the left side by its control points, LPS mm; the right side's is its mirror image.
struct Trunk {
  std::string_view name;
  std::string_view parent;  ///< branches off this one's nearest node; empty: blood enters here
  Territory feeds = Territory::None;
  bool midline = false;  ///< there is only one
  std::vector<glm::dvec3> controls_mm;
};

/// The arteries from the base of the skull to where they divide over the cortex; parents first.
std::vector<Trunk> cerebral_trunks();

/// How finely a territory is fed.
struct TerritorySupply {
  Territory territory;
  int targets;  ///< number of points to feed, on each side
};

/// All territories but None.
std::span<const TerritorySupply> territory_supplies();

/// Points of a territory on the left side (x > 0), LPS mm, evenly spread (each the best of eight
/// candidates: Mitchell 1991, "Spectrally optimal sampling for distribution ray tracing").
std::vector<glm::dvec3> territory_targets(const TerritorySupply& supply, RandomSequence& random);

}  // namespace nacre

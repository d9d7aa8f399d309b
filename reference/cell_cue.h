#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "reference/cue_field.h"
#include "reference/walk_field.h"

namespace nacre {

/// A depth cue as a function of the place in cell coordinates:
///
///     beta(p) = at_origin + rise . p.
class CellCue {
 public:
  CellCue(const WalkField& field, const CueField& cue)
      : rise_(glm::transpose(field.frame.world_from_cell) * cue.rise_per_mm),
        at_origin_(cue.at_center +
                   glm::dot(cue.rise_per_mm, field.frame.center_mm - cue.center_mm) -
                   glm::dot(rise_, field.frame.center_cell)) {}

  /// Never below the greatest cue within a cube of cells.
  double greatest(const glm::ivec3& first_cell, int side) const {
    constexpr double kSafely = 1e-12;
    const double half = 0.5 * side;
    const double at_center = at_origin_ + glm::dot(rise_, glm::dvec3(first_cell) + half);
    const double around = half * (std::abs(rise_.x) + std::abs(rise_.y) + std::abs(rise_.z));
    return std::max(0.0, at_center + around + kSafely * (std::abs(at_origin_) + around));
  }

  const glm::dvec3& rise() const { return rise_; }
  double at_origin() const { return at_origin_; }

 private:
  glm::dvec3 rise_;
  double at_origin_;
};

}  // namespace nacre

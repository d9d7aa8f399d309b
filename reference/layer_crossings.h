#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>

#include "reference/layer_ladder.h"
#include "reference/walk_field.h"

namespace nacre {

/// A line's crossing of an ideal shell.
struct LayerCrossing {
  std::size_t level = 0;         ///< index of the shell's level
  double t = 0.0;                ///< along the line, mm
  bool entering = true;          ///< else leaving
  glm::ivec3 cell{0};            ///< where it is
  std::optional<int> face_axis;  ///< of the border face it lies in, if it is in a cap
};

/// Calls `on_crossing` for each crossing, from near to far; false ends the walk. Caps count where
/// the line passes a border face (docs/derivations.md, section 2.6).
void for_each_crossing(const WalkField& field, const LayerLadder& ladder, const BoxPassage& passage,
                       const std::function<bool(const LayerCrossing&)>& on_crossing);

/// The shell's outward normal in world coordinates at a crossing: that of the border plane for a
/// cap; else the field's falling gradient in the crossing's cell, through the inverse transpose of
/// `world_from_voxel`. Of unit length; 0 where the gradient vanishes.
glm::dvec3 outward_normal(const WalkField& field, const CellLine& line,
                          const LayerCrossing& crossing);

}  // namespace nacre

#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/shell_set.h"
#include "core/volume_geometry.h"

namespace nacre {

/// Rounds positions to a set's grid so that its surfaces cover the volume up to its border
/// (docs/decisions/028-exact-borders.md).
///
/// What lies in border planes, where shells are capped, goes outwards: to the nearest grid point on
/// or beyond each of these planes, up to about a step away from them. Anything else goes to the
/// nearest.
class BorderRounding {
 public:
  /// @param set      its volume's box and its grid
  /// @throws Error   BadArgument if it has no grid or states no volume
  explicit BorderRounding(const ShellSet& set);

  /// Whether a position lies in a border plane or beyond: a hundredth of a voxel within it still
  /// does, since simplification rounds a box's edges by a thousandth at a time.
  bool is_on_border(const glm::dvec3& p_mm) const { return planes_at(p_mm) != 0; }

  /// The grid point that a position goes to. Where none around lies beyond all of its planes, at a
  /// sharp corner of a sheared box or the grid's end, the one that is the least within one of them.
  glm::ivec3 index(const glm::dvec3& p_mm) const;

 private:
  /// A bit a plane: 2 axis for the low, 2 axis + 1 for the high one.
  unsigned planes_at(const glm::dvec3& p_mm) const;
  glm::dvec3 onto(const glm::dvec3& p_mm, unsigned planes) const;
  double inward_voxels(const glm::dvec3& p_mm, unsigned planes) const;
  glm::dvec3 voxel(const glm::dvec3& p_mm) const {
    return glm::dvec3(voxel_from_local_ * glm::dvec4(p_mm, 1.0));
  }

  QuantizationGrid grid_;
  VoxelBox box_;
  glm::dmat4 voxel_from_local_;
  glm::dmat4 local_from_voxel_;
};

}  // namespace nacre

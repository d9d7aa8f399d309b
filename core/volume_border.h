#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "core/shell_set.h"
#include "core/triangle_mesh.h"
#include "core/volume_geometry.h"

namespace nacre {

/// Whether a volume is stated whose box has an inside: its matrix is regular.
bool has_border(const VolumeFacts& volume) noexcept;

/// Puts positions beyond a volume's box onto its border.
///
/// Shells are capped in the border planes. Their vertices are on a grid, which an oblique volume's
/// planes do not pass through, and so lie up to about a step beyond (`BorderRounding` in shells);
/// whoever shows a surface moves them back, and has the caps where they belong
/// (docs/decisions/028-exact-borders.md).
class VolumeBorder {
 public:
  /// @param center_mm  LPS, what positions are relative to
  /// @pre  `has_border`
  VolumeBorder(const VolumeFacts& volume, const glm::dvec3& center_mm);

  /// The nearest point of the box, in voxel coordinates; a position within it, or off it by
  /// rounding alone, is returned bit for bit.
  glm::vec3 operator()(const glm::vec3& p_mm) const;

 private:
  VoxelBox box_;
  glm::dvec3 offset_mm_;  ///< of what positions are relative to, from the box's centre
  glm::dmat4 voxel_from_local_;
  glm::dmat4 local_from_voxel_;
};

/// A set's surface with what lies beyond its volume's box put onto the border: what is to be shown.
/// Triangles stay what they are; those that stood across the border may have no area.
///
/// @return nothing where nothing moves, or the set states no volume: the surface is shown as it is
std::optional<TriangleMesh> within_border(const ShellSet& set, const TriangleMesh& surface);

}  // namespace nacre

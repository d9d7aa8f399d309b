#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/emission.h"
#include "core/volume.h"
#include "core/volume_geometry.h"

namespace nacre {

/// The trilinear field of a volume's values, at positions in LPS mm relative to its box's centre
/// (the frame of a shell's surface).
class TrilinearField {
 public:
  /// @param volume  must outlive the field
  /// @throws Error  BadArgument if its matrix is singular
  explicit TrilinearField(const Volume& volume);

  /// A position in voxel coordinates.
  glm::dvec3 voxel_from_local(const glm::dvec3& p_mm) const noexcept {
    const glm::dvec4 p_voxel = voxel_from_local_ * glm::dvec4(p_mm, 1.0);
    return {p_voxel.x, p_voxel.y, p_voxel.z};
  }

  /// The value at a position in voxel coordinates; beyond the box that of its nearest point.
  double value(const glm::dvec3& p_voxel) const noexcept { return value_(*this, p_voxel); }

  const VoxelBox& box() const noexcept { return box_; }

  const Volume& volume() const noexcept { return volume_; }

 private:
  template <class T>
  static double value_of(const TrilinearField& field, const glm::dvec3& p_voxel) noexcept;

  const Volume& volume_;
  VoxelBox box_;
  glm::dmat4 voxel_from_local_;
  double (*value_)(const TrilinearField&, const glm::dvec3&) noexcept;
};

/// How far off its level a surface is at a point: |phi(p) - t_k|, in emission units.
///
/// On the volume's border, where shells are capped, a point inside the set is where it belongs: its
/// error is 0. Elsewhere in the border plane, and within the volume, it is as above.
class LevelError {
 public:
  /// @param field, emission  must outlive this
  /// @param level            t_k
  LevelError(const TrilinearField& field, const EmissionMap& emission, double level)
      : field_(field), emission_(emission), level_(level) {}

  /// @param p_mm  LPS, relative to the centre of the volume's box
  double operator()(const glm::dvec3& p_mm) const noexcept;

 private:
  const TrilinearField& field_;
  const EmissionMap& emission_;
  double level_;
};

}  // namespace nacre

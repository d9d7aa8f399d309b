#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/emission.h"
#include "core/volume.h"
#include "core/volume_geometry.h"

namespace nacre {

struct ValueAndGradient {
  double value;
  glm::dvec3 gradient;
};

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

  /// The same for offsets.
  glm::dmat3 voxel_from_mm() const noexcept { return static_cast<glm::dmat3>(voxel_from_local_); }

  /// The value at a position in voxel coordinates; beyond the box that of its nearest point.
  double value(const glm::dvec3& p_voxel) const noexcept { return value_(*this, p_voxel); }

  /// The value and its gradient per voxel, by the cell above where two meet; beyond the box the
  /// value of its nearest point, with that point's gradient.
  ValueAndGradient sample(const glm::dvec3& p_voxel) const noexcept {
    return sample_(*this, p_voxel);
  }

  /// A gradient per voxel as one per mm. In a border plane the part within the plane only: who
  /// follows it stays there.
  glm::dvec3 gradient_per_mm(const glm::dvec3& p_voxel,
                             const glm::dvec3& per_voxel) const noexcept {
    const glm::dvec3 gradient = per_voxel * voxel_from_mm();
    return is_within(p_voxel) ? gradient : along_border(p_voxel, gradient);
  }

  /// Whether a position lies in a border plane of the box, as near as floats tell.
  bool is_on_border(const glm::dvec3& p_voxel) const noexcept;
  bool is_on_border(const glm::dvec3& p_voxel, int axis) const noexcept;
  /// Whether it lies farther within the box than that.
  bool is_within(const glm::dvec3& p_voxel) const noexcept {
    const glm::dvec3& lo = within_.lo;
    const glm::dvec3& hi = within_.hi;
    return p_voxel.x > lo.x && p_voxel.y > lo.y && p_voxel.z > lo.z && p_voxel.x < hi.x &&
           p_voxel.y < hi.y && p_voxel.z < hi.z;
  }
  /// Whether it lies farther out than that.
  bool is_outside(const glm::dvec3& p_voxel) const noexcept;

  const VoxelBox& box() const noexcept { return box_; }

  const Volume& volume() const noexcept { return volume_; }

 private:
  glm::dvec3 along_border(const glm::dvec3& p_voxel, glm::dvec3 gradient) const noexcept;
  template <class T>
  static double value_of(const TrilinearField& field, const glm::dvec3& p_voxel) noexcept;
  template <class T>
  static ValueAndGradient sample_of(const TrilinearField& field,
                                    const glm::dvec3& p_voxel) noexcept;

  const Volume& volume_;
  VoxelBox box_;
  VoxelBox within_;  ///< the box without what counts as its border
  glm::dmat4 voxel_from_local_;
  double (*value_)(const TrilinearField&, const glm::dvec3&) noexcept;
  ValueAndGradient (*sample_)(const TrilinearField&, const glm::dvec3&) noexcept;
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

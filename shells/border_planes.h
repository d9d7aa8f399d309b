#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/shell_set.h"

namespace nacre {

/// The border planes of a set's volume, where all its shells are capped and their caps lie on each
/// other.
class BorderPlanes {
 public:
  /// @param set  its volume, and its grid if it was snapped: vertices then lie up to half a step
  ///             along each axis off the plane
  explicit BorderPlanes(const ShellSet& set);

  bool contain(const glm::vec3& p_mm) const { return planes_at(p_mm) != 0; }

  /// Whether a triangle lies in one of them.
  bool hold_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) const {
    return (planes_at(a) & planes_at(b) & planes_at(c)) != 0;
  }

  /// A surface without its caps.
  TriangleMesh without_caps(const TriangleMesh& mesh) const;

 private:
  /// A bit a plane.
  unsigned planes_at(const glm::vec3& p_mm) const;

  VoxelBox box_;
  glm::dmat4 voxel_from_local_{1.0};
  double border_voxels_;
};

}  // namespace nacre

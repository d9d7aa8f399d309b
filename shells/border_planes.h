#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/shell_set.h"

namespace nacre {

/// The border planes of a set's volume, where all its shells are capped and their caps lie on each
/// other.
class BorderPlanes {
 public:
  /// @param set  its volume, and its grid if it was snapped: vertices then lie anywhere beyond the
  ///             plane (`BorderRounding`), or up to half a step along each axis within, where they
  ///             had to make way or the set is an early one
  explicit BorderPlanes(const ShellSet& set);

  bool contain(const glm::vec3& p_mm) const { return planes_at(p_mm) != 0; }

  /// A surface's triangles without its caps: those that lie in one of the planes.
  std::vector<glm::uvec3> triangles_off(const TriangleMesh& mesh) const;

  /// A surface without its caps.
  TriangleMesh without_caps(const TriangleMesh& mesh) const {
    return {mesh.positions, triangles_off(mesh)};
  }

 private:
  /// A bit a plane.
  unsigned planes_at(const glm::vec3& p_mm) const;

  VoxelBox box_;
  glm::dmat4 voxel_from_local_{1.0};
  double border_voxels_;
};

}  // namespace nacre

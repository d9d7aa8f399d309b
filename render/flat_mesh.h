#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace nacre {

/// A mesh for flat shading: each triangle's last vertex is its own and has its normal.
///
/// OpenGL takes what does not vary over a triangle from its last vertex. Most vertices can be lent
/// to one of the triangles around them; only where all are taken is one copied, so that there are
/// about as many vertices as triangles and not three times as many.
struct FlatMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;     ///< of unit length; 0 for a triangle without area
  std::vector<glm::uvec3> triangles;  ///< in the order and with the winding given
};

/// @pre  indices are within `positions`
FlatMesh flat_mesh(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles);

}  // namespace nacre

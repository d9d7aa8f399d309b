#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace nacre {

/// An indexed triangle mesh. Triangles are counter-clockwise seen from outside.
///
/// The frame and unit of the positions are said where a mesh is used.
struct TriangleMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;  ///< three indices into `positions`
};

}  // namespace nacre

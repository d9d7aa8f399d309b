#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "core/triangle_mesh.h"

namespace nacre {

/// A surgical tool: an opaque triangle mesh with a colour and a pose.
///
/// The mesh may be open, non-manifold and of any winding: it is seen and lit on both sides. Its
/// positions are finite, in the file's own frame and unit.
struct Tool {
  std::string name;  ///< of the file, for messages and figures
  TriangleMesh mesh;
  glm::dmat4 world_from_tool{1.0};     ///< to LPS mm: a rigid pose times a scale; affine, regular
  glm::vec3 color{0.35f, 0.7f, 1.0f};  ///< as displayed, RGB in [0, 1]
};

}  // namespace nacre

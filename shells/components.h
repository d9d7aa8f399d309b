#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/triangle_mesh.h"

namespace nacre {

/// A part of a surface connected by shared vertices.
struct Component {
  std::uint32_t first_triangle = 0;
  std::size_t triangles = 0;
  double volume_mm3 = 0.0;  ///< signed: negative for a cavity
  glm::vec3 lo{0.0F};       ///< bounds
  glm::vec3 hi{0.0F};
};

/// The components of a surface, in the order of their first triangles.
struct Components {
  std::vector<Component> list;
  std::vector<std::uint32_t> of_triangle;  ///< index into `list`
};

/// Finds the components of a surface and measures them.
Components find_components(const TriangleMesh& mesh);

/// Which components lie inside the outer surface of another one, i.e. within a component of
/// positive volume taken alone.
///
/// Decided for one point of each, off all edges: components of one shell do not cross. The signed
/// crossings of a ray along +z with each other component tell whether it is inside.
std::vector<bool> inner_components(const TriangleMesh& mesh, const Components& components);

}  // namespace nacre

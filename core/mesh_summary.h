#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

#include "core/triangle_mesh.h"

namespace nacre {

/// What is true of a mesh that need not be closed, oriented or manifold, found by counting.
///
/// Vertices are told apart by their positions: two with the same one are one here, because some
/// formats repeat a vertex for each triangle or for each texture coordinate.
struct MeshSummary {
  std::size_t triangles = 0;
  std::size_t vertices = 0;            ///< distinct positions that triangles use
  std::size_t without_area = 0;        ///< triangles with two equal corners
  std::size_t open_edges = 0;          ///< edges of one triangle
  std::size_t non_manifold_edges = 0;  ///< edges of more than two
  /// Enclosed, in the mesh's unit cubed: positive where triangles are counter-clockwise seen from
  /// outside. Of no meaning with open edges.
  double signed_volume = 0.0;
  glm::dvec3 lo{0.0};  ///< bounds of the positions that triangles use
  glm::dvec3 hi{0.0};
};

/// @pre  positions are finite and all indices exist
MeshSummary summarize(const TriangleMesh& mesh);

}  // namespace nacre

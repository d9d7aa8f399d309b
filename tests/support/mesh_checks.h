#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <string>

#include "core/triangle_mesh.h"

namespace nacre::testing {

/// What is true of a surface, found by counting.
struct MeshFacts {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t unpaired_edges = 0;   ///< directed edges without exactly one opposite
  std::size_t repeated_edges = 0;   ///< directed edges that occur more than once
  std::size_t degenerate = 0;       ///< triangles with a repeated index or without area
  std::size_t unused_vertices = 0;  ///< in no triangle
  std::size_t components = 0;
  bool finite = true;     ///< all positions are
  double area = 0.0;      ///< mm^2
  double volume = 0.0;    ///< enclosed, signed, mm^3
  double least_area = 0;  ///< of a triangle, mm^2
  glm::dvec3 lo{0.0};     ///< bounds
  glm::dvec3 hi{0.0};

  /// V - E + F, for a closed mesh.
  long euler_number() const {
    return static_cast<long>(vertices) - static_cast<long>(triangles) / 2;
  }
};

MeshFacts facts_of(const TriangleMesh& mesh);

/// Empty if the mesh is closed, edge-manifold, consistently oriented, finite and without degenerate
/// triangles or unused vertices; else what is wrong.
std::string flaw_of(const MeshFacts& facts);

}  // namespace nacre::testing

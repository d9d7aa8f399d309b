#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shells/closed_mesh.h"
#include "shells/quadric.h"
#include "shells/surface_field.h"

namespace nacre {

/// Where an edge's quadric is least, and what it costs to go there.
struct CollapseTarget {
  glm::dvec3 point;
  double error;  ///< squared, times area
  double cost;   ///< the same, and a little for the edge's length: what is the cheapest
  double area;   ///< that the quadric stands for
};

/// Quadrics of a mesh's vertices for collapsing edges (Garland, Heckbert 1997, "Surface
/// Simplification Using Quadric Error Metrics"): of the tangent planes that a field has at the
/// triangles' centres, in units of its error, or of the triangles' own planes where it has none.
class FieldQuadrics {
 public:
  /// @param field       what the surface should be a zero of; may be empty
  /// @param spacing_mm  how far an error of one is where the field has no gradient
  FieldQuadrics(const ClosedMesh& mesh, std::span<const glm::dvec3> positions,
                const SurfaceField& field, double spacing_mm);

  /// For the vertex that an edge's ends become: no farther from its middle than the edge is long.
  CollapseTarget target(const ClosedMesh& mesh, std::span<const glm::dvec3> positions,
                        std::uint32_t h) const;

  /// Vertex v stands for vertex u, too.
  void merge(std::uint32_t u, std::uint32_t v) { quadrics_[v] += quadrics_[u]; }

 private:
  std::vector<Quadric> quadrics_;
};

}  // namespace nacre

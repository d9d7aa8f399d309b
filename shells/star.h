#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shells/closed_mesh.h"

namespace nacre {

/// A triangle of a star: (apex, ring[i], ring[i + 1]).
struct StarTriangle {
  glm::dvec3 apex_before;    ///< where its apex lies now
  glm::dvec3 normal_beyond;  ///< of the triangle across the ring's side, any length
  std::uint32_t face;
};

/// The triangles about a vertex that is to be placed, as they will be: a closed ring, counter-
/// clockwise seen from outside, and an apex to choose.
struct Star {
  std::vector<glm::dvec3> ring;
  std::vector<StarTriangle> triangles;  ///< one from each ring vertex to the next
  /// What vanishes: the triangles of the edge that is collapsed, each an apex and its ring side.
  struct Removed {
    glm::dvec3 a, b, c;
    std::uint32_t face;
  };
  std::vector<Removed> removed;

  const glm::dvec3& after(std::size_t i) const { return ring[i + 1 == ring.size() ? 0 : i + 1]; }
};

/// The star that a vertex has.
void star_of_vertex(const ClosedMesh& mesh, std::span<const glm::dvec3> positions,
                    std::uint32_t vertex, Star& star);

/// The star that the vertex which h's ends become will have.
void star_of_collapse(const ClosedMesh& mesh, std::span<const glm::dvec3> positions,
                      std::uint32_t h, Star& star);

/// Whether the star's triangles, with their apex at p, are as good as a surface's should be: none
/// turns by more than some 75 degrees against what it was, or is a sliver unless it was one; no
/// edge between two of them is folded by more than some 155 degrees, or to a triangle beyond unless
/// it was.
bool keeps_shape(const Star& star, const glm::dvec3& p);

}  // namespace nacre

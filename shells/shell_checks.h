#pragma once

#include <cstddef>
#include <cstdint>

#include "core/triangle_mesh.h"

namespace nacre {

/// What a surface is, counted. Plain code over indices, without a geometry library.
struct ShellReport {
  std::size_t triangles = 0;
  std::size_t vertices = 0;    ///< that triangles use
  std::size_t components = 0;  ///< connected by shared vertices

  std::size_t open_edges = 0;           ///< edges of an odd number of triangles
  std::size_t misoriented_edges = 0;    ///< not as many triangles one way as the other
  std::size_t crowded_edges = 0;        ///< edges of more than two triangles
  std::size_t crowded_vertices = 0;     ///< vertices whose triangles form more than one fan
  std::size_t degenerate = 0;           ///< triangles without area, or with a repeated vertex
  std::size_t coincident_vertices = 0;  ///< vertices at the position of an earlier one

  std::int64_t euler = 0;  ///< vertices - edges + triangles: 2 a sphere, 0 a torus
  double area_mm2 = 0.0;
  double volume_mm3 = 0.0;  ///< signed: positive if counter-clockwise seen from outside

  bool is_closed() const noexcept { return open_edges == 0 && misoriented_edges == 0; }
  bool is_manifold() const noexcept { return crowded_edges == 0 && crowded_vertices == 0; }
  /// Closed, oriented, manifold also for who merges equal positions, without degenerate triangles,
  /// its inside on its inner side. So is the empty surface.
  bool is_sound() const noexcept {
    return is_closed() && is_manifold() && degenerate == 0 && coincident_vertices == 0 &&
           (triangles == 0 || volume_mm3 > 0.0);
  }
};

/// Counts what a surface is.
///
/// Areas are exactly zero or not for positions on a grid of up to 23 bits (products of differences
/// fit a double); other positions may round.
///
/// @pre  indices are in range
/// O(n log n); 3 million triangles take about two seconds.
ShellReport check_shell(const TriangleMesh& mesh);

}  // namespace nacre

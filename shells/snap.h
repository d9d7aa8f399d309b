#pragma once

#include <cstddef>

#include "core/shell_set.h"
#include "core/triangle_mesh.h"
#include "shells/border_rounding.h"

namespace nacre {

/// What snapping a surface took.
struct SnapReport {
  std::size_t collapsed_edges = 0;  ///< ends at one grid point, or a step apart where it is crowded
  std::size_t moved_vertices = 0;   ///< to a free grid point nearby, to keep sheets apart
  std::size_t flipped_edges = 0;    ///< to resolve triangles without area
  std::size_t dropped_components = 0;  ///< specks that collapsed to nothing, or turned over

  SnapReport& operator+=(const SnapReport& other);
};

struct SnappedSurface {
  TriangleMesh mesh;
  SnapReport report;
};

/// Moves a surface's vertices to a grid and cleans what collapses.
///
/// The result is closed, oriented and manifold as the surface was, *also for whoever merges
/// vertices by position*: no two vertices share a grid point. Where welding would join two sheets,
/// one vertex gives way to the nearest free point instead, most often one step away. No triangle is
/// without area, exactly, in grid coordinates. Every component keeps the sign of its volume (a
/// cavity is a component of negative volume); those that shrink to nothing vanish.
///
/// @param surface  closed, oriented, manifold; positions within the grid, in its frame
/// @param grid     exact, see core/quantization_grid.h
/// @param border   for that grid: what lies in the volume's border planes goes outwards (but for
///                 single vertices that have to make way); null: everything goes to the nearest
///                 point
/// @throws Error   BadArgument if the surface is not closed and manifold, the grid is not exact, or
///                 it is too coarse to hold the surface
///
/// O(triangles). The order of vertices and triangles is that of the surface.
SnappedSurface snap(const TriangleMesh& surface, const QuantizationGrid& grid,
                    const BorderRounding* border = nullptr);

}  // namespace nacre

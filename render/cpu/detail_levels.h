#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"
#include "render/cpu/mesh_clusters.h"

namespace nacre {

/// A closed surface at one level of detail.
struct DetailLevel {
  MeshClusters mesh;
  /// Bound of the distance by which any point of the surface was moved, mm; 0 for the surface
  /// itself.
  double error_mm = 0.0;
};

/// A surface with the vertices in each cell of a cubic grid merged (Rossignac, Borrel 1993,
/// "Multi-resolution 3D approximations for rendering complex scenes"), to the point that is nearest
/// to the planes of the triangles around them: a mean would make what is thin thinner.
struct MergedVertices {
  TriangleMesh mesh;                     ///< without the triangles that lost their area
  std::vector<std::uint32_t> merged_to;  ///< of each vertex before: its index in `mesh`
};

/// Merges the vertices in each cell. The surface stays closed: every edge that is left is shared by
/// as many triangles one way as the other, so front and back faces cover the same pixels still.
///
/// @param cell_mm  side of the cells, positive
MergedVertices merge_vertices(const TriangleMesh& mesh, double cell_mm);

/// The surface itself and, after it, coarser ones: each with cells twice as wide, the first with
/// the mean edge, until one has at most `least_triangles`. Cells that save less than 3 in
/// 10 of the triangles make no level.
///
/// About 60 ns a triangle; 100 with all levels.
std::vector<DetailLevel> detail_levels(const TriangleMesh& mesh, std::size_t least_triangles);

}  // namespace nacre

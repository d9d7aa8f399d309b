#pragma once

#include <cstddef>
#include <limits>
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

/// The surface itself and, after it, coarser ones, each made from the one before by merging
/// vertices along edges (`EdgeMerging`), until one has at most `least_triangles`. From one to the
/// next they may go the root of two times as far, so there are about half as many triangles; what
/// saves less than 3 in 10 makes no level.
///
/// About 0.5 us a triangle with all levels. They keep about 30 bytes a triangle of the surface, 1.7
/// times its own memory, 14 of them for the surface itself; while they are made it is up to 110,
/// mostly for `EdgeMerging`.
///
/// @param most_mm  of `cluster_mesh`
std::vector<DetailLevel> detail_levels(const TriangleMesh& mesh, std::size_t least_triangles,
                                       double most_mm = std::numeric_limits<double>::infinity());

}  // namespace nacre

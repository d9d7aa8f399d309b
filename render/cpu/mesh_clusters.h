#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "core/triangle_mesh.h"

namespace nacre {

/// Bounds of a few neighbouring triangles, and where they lie in their `MeshClusters`.
struct Cluster {
  glm::vec3 center_mm{0.0F};  ///< of the bounding box
  glm::vec3 extent_mm{0.0F};  ///< half its sides
  /// Cone of the normals: a triangle of area faces a direction at most asin(`cone_sine`) from the
  /// axis. A sine above 1 says nothing of them.
  glm::vec3 cone_axis{0.0F};
  float cone_sine = 2.0F;
  std::uint32_t first_position = 0;  ///< into `positions`: x of all vertices, then y, then z
  std::uint32_t first_corner =
      0;                        ///< into `corners`: first corners of all triangles, second, third
  std::uint16_t vertices = 0;   ///< padded to a multiple of `kLanePadding`
  std::uint16_t triangles = 0;  ///< likewise
};

/// Vertices and triangles of a cluster are padded to a multiple of this, vertices by repetition and
/// triangles by ones without area, so that vector code needs no remainder loop.
inline constexpr std::size_t kLanePadding = 16;

/// Limits of a cluster before padding: corners are bytes.
inline constexpr std::size_t kClusterTriangles = 128;
inline constexpr std::size_t kClusterVertices = 240;

/// A mesh cut into clusters of neighbouring triangles, each with vertices of its own: what is
/// culled, projected and drawn as one, from a few kilobytes that are read in one go.
struct MeshClusters {
  std::vector<Cluster> clusters;
  std::vector<float> positions;
  std::vector<std::uint8_t> corners;
  std::size_t triangles = 0;  ///< of the mesh, without padding

  std::size_t bytes() const noexcept;
};

/// Mean length of one edge of each triangle.
/// @pre  the mesh has triangles
double mean_edge_mm(const TriangleMesh& mesh);

/// Cuts a mesh into clusters along the Morton curve through its triangles' centres (Morton 1966,
/// "A computer oriented geodetic data base"), so that they are compact however the mesh is ordered.
///
/// @param most_mm  a cluster spans about this along each axis at most, or a single triangle: in
///                 pictures the kernels draw none that is too wide
///
/// One thread; about 50 ns a triangle. The result depends on the arguments alone.
/// @pre  indices within the positions, which are finite
MeshClusters cluster_mesh(const TriangleMesh& mesh,
                          double most_mm = std::numeric_limits<double>::infinity());

}  // namespace nacre

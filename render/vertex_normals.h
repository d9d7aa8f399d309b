#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/triangle_mesh.h"

namespace nacre {

/// Smooth normals of a mesh, of unit length, outwards where triangles are counter-clockwise seen
/// from outside: at a vertex the sum of its triangles' normals, each weighted with the triangle's
/// angle there (Thurmer and Wuthrich 1998, "Computing Vertex Normals from Polygonal Facets", eq.
/// 1), which does not depend on how flat faces are cut into triangles.
///
/// @return  one a position; 0 where no triangle of positive area has the vertex
std::vector<glm::vec3> vertex_normals(const TriangleMesh& mesh);

}  // namespace nacre

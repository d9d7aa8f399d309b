#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/triangle_mesh.h"

namespace nacre {

/// Normals at a mesh's vertices, of unit length: at each the sum of its triangles' normals,
/// weighted with their angles there (Thuermer, Wuethrich 1998, "Computing Vertex Normals from
/// Polygonal Facets"), so that it does not depend on how faces are cut into triangles.
///
/// @return  one a position, outwards where triangles are counter-clockwise seen from outside; 0
///          where no triangle with an area is
std::vector<glm::dvec3> smooth_normals(const TriangleMesh& mesh);

}  // namespace nacre

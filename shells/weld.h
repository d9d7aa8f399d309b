#pragma once

#include "core/triangle_mesh.h"

namespace nacre {

/// A surface whose vertices at one position are one vertex: the first of them. Triangles stay, in
/// order, also those that lose a corner. For meshes of writers that repeat vertices.
TriangleMesh weld(const TriangleMesh& mesh);

}  // namespace nacre

#pragma once

#include <filesystem>

#include "core/triangle_mesh.h"
#include "io/mesh_format.h"
#include "io/plain_mesh.h"

namespace nacre {

/// Has OpenMesh read a reduced mesh file, keeping every face of it: OpenMesh's own meshes drop
/// those that make them non-manifold, so its reader fills lists of vertices and faces here.
/// Polygons become fans of triangles about their first corner, which is right where they are
/// convex.
///
/// OpenMesh's readers keep state of their own: one thread at a time.
///
/// @param path     for messages
/// @throws Error   BadFile if OpenMesh does not find the counted vertices and faces, a vertex is
/// not
///                 finite, or a face has corners that do not exist
TriangleMesh read_with_openmesh(const std::filesystem::path& path, MeshFormat format,
                                PlainMesh plain);

}  // namespace nacre

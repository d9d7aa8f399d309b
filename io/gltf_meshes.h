#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/triangle_mesh.h"

namespace nacre {

/// A mesh of a glTF file, in the frame of its own positions: nodes do not move it.
struct GltfMesh {
  std::string name;
  TriangleMesh surface;
};

/// The triangle meshes of a binary glTF file (`.glb`), whoever wrote it.
struct GltfMeshes {
  bool is_shell_set = false;     ///< whether a node carries `extras.nacre`
  std::vector<GltfMesh> meshes;  ///< one a primitive of triangles
  std::size_t left_out = 0;      ///< primitives of points, lines, strips or fans
};

/// Whether a file carries `extras.nacre`: decodes nothing.
/// @throws Error  BadFile if it is no binary glTF file
bool is_shell_file(const std::filesystem::path& path);

/// Reads the meshes of a file: positions as floats, indices of 8, 16 or 32 bits or none, in the
/// file's own buffer, plain or compressed by Draco with positions only.
///
/// Nothing is trusted: every length is checked before anything is allocated for it.
///
/// @throws Error  BadFile: "PATH: found ..., expected ..."; Unsupported for sparse accessors, other
///                component types, external buffers, and Draco data with further attributes
GltfMeshes read_gltf_meshes(const std::filesystem::path& path,
                            const ProgressCallback& progress = {});

}  // namespace nacre

#pragma once

#include <filesystem>

#include "core/tool.h"

namespace nacre {

/// Whether a name has an ending of a tool mesh: .stl, .obj, .ply or .off, in any case.
bool is_tool_name(const std::filesystem::path& path);

/// Reads a tool mesh: STL (binary and ASCII), Wavefront OBJ, PLY (ASCII, both byte orders) or OFF
/// (text), by the name's ending.
///
/// Every triangle of the file is kept, also where the mesh is open, non-manifold or has triangles
/// without area (STL's that have two equal corners excepted); polygons become fans of triangles.
/// Positions are in the file's own frame and unit, which none of these formats states:
/// `world_from_tool` is the identity, the colour the default one, the name that of the file.
///
/// OpenMesh, underneath, keeps state of its own: read from one thread at a time.
///
/// @throws Error  BadFile for what is missing, damaged, empty, or no mesh of these formats;
///                Unsupported in a build without OpenMesh
Tool read_tool(const std::filesystem::path& path);

}  // namespace nacre

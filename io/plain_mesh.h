#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace nacre {

/// A mesh file reduced to what OpenMesh's readers take without harm: positions and faces, in the
/// file's own numbers.
///
/// OpenMesh reads files that end early, numbers that are none (as 0) and dialects that it does not
/// know (as something else) without a word, and some headers make it loop. So each file is first
/// gone through by one of these functions, which refuses what is damaged, drops what no tool
/// needs (colours, normals, materials, comments) and counts what OpenMesh must find.
struct PlainMesh {
  std::string bytes;
  bool binary = false;
  std::size_t vertices = 0;  ///< OpenMesh must find so many; for STL it finds out itself: 0
  std::size_t faces = 0;     ///< exactly so many, or at most for STL, where it drops empty ones
};

// Each throws Error BadFile, a line that names the place, for what is damaged or of another kind.

/// Both kinds of STL. A binary one may have bytes after the triangles that it counts, but not a
/// whole number of triangles more; an ASCII one may hold several solids, and anything after the
/// last one ends.
PlainMesh plain_stl(const std::filesystem::path& path, std::string bytes);

/// `v` and `f` statements of a Wavefront OBJ; other known ones are dropped, unknown ones refused.
PlainMesh plain_obj(const std::filesystem::path& path, std::string bytes);

/// The elements `vertex` (x, y, z) and `face` (vertex_indices) of an ASCII or binary PLY of either
/// byte order, with any other properties and elements beside them.
PlainMesh plain_ply(const std::filesystem::path& path, std::string_view bytes);

/// A text OFF: one vertex and one face a line, with or without colours and normals.
PlainMesh plain_off(const std::filesystem::path& path, std::string_view bytes);

}  // namespace nacre

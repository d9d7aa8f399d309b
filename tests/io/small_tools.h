#pragma once

#include <string>
#include <string_view>

#include "core/triangle_mesh.h"

namespace nacre::testing {

/// A cube's corner cut off: 4 vertices, 4 triangles, closed and outward, volume 1/6.
TriangleMesh small_tetrahedron();

// The same mesh in each format.
std::string binary_stl(const TriangleMesh& mesh);
std::string ascii_stl(const TriangleMesh& mesh);
std::string obj_text(const TriangleMesh& mesh);
std::string off_text(const TriangleMesh& mesh);
std::string ascii_ply(const TriangleMesh& mesh);
std::string binary_ply(const TriangleMesh& mesh, bool big_endian);

/// A text with another line end.
std::string with_line_ends(std::string_view text, std::string_view end);

}  // namespace nacre::testing

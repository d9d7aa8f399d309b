#pragma once

#include <string>

#include "core/triangle_mesh.h"
#include "core/volume_geometry.h"

namespace nacre {

/// A tool where none is at hand: a closed rod through the sphere's centre, from the upper left
/// front inwards, its thickness a thirtieth of the sphere's radius. LPS mm.
TriangleMesh needle(const BoundingSphere& sphere);

/// A mesh as the bytes of a binary STL file; reading it gives the same positions.
std::string stl_bytes(const TriangleMesh& mesh);

}  // namespace nacre

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace nacre {

/// A decimator that knows nothing of the field: quadric errors of the surface's own planes.
struct PlainDecimator {
  std::string name;
  TriangleMesh (*simplify)(const TriangleMesh& surface, std::size_t triangles);
};

/// OpenMesh's, and meshoptimizer's and VTK's where they are installed.
std::vector<PlainDecimator> plain_decimators();

/// A mesh that went through Draco on a grid over its own box.
struct PlainMesh {
  std::size_t bytes = 0;
  TriangleMesh decoded;
};

/// @param bits  of a coordinate
PlainMesh through_draco(const TriangleMesh& surface, int bits);

/// The bytes alone, without decoding them.
std::size_t draco_bytes(const TriangleMesh& surface, int bits);

}  // namespace nacre

#pragma once

#include <cstddef>

#include "core/triangle_mesh.h"

namespace nacre {

/// What VTK's vtkQuadricDecimation leaves of a surface (geometry alone, its defaults otherwise).
/// @param triangles  to aim at
TriangleMesh by_vtk(const TriangleMesh& surface, std::size_t triangles);

}  // namespace nacre

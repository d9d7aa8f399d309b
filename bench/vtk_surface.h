#pragma once

#include "core/triangle_mesh.h"

class vtkPolyData;

namespace nacre {

/// The points and triangles of VTK's mesh.
TriangleMesh surface_of(vtkPolyData& mesh);

}  // namespace nacre

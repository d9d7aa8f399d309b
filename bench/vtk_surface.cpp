#include "bench/vtk_surface.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cstdint>

namespace nacre {

TriangleMesh surface_of(vtkPolyData& mesh) {
  TriangleMesh surface;
  for (vtkIdType i = 0; i < mesh.GetNumberOfPoints(); ++i) {
    const double* p = mesh.GetPoint(i);
    surface.positions.emplace_back(p[0], p[1], p[2]);
  }
  vtkNew<vtkIdList> corners;
  const auto corner = [&](vtkIdType i) { return static_cast<std::uint32_t>(corners->GetId(i)); };
  for (vtkIdType i = 0; i < mesh.GetPolys()->GetNumberOfCells(); ++i) {
    mesh.GetPolys()->GetCellAtId(i, corners);
    surface.triangles.emplace_back(corner(0), corner(1), corner(2));
  }
  return surface;
}

}  // namespace nacre

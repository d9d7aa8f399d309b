#include "bench/vtk_decimator.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>

#include <cstdint>

namespace nacre {
namespace {

void fill(vtkPolyData& mesh, const TriangleMesh& surface) {
  vtkNew<vtkPoints> points;
  for (const glm::vec3& p : surface.positions) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkCellArray> faces;
  for (const glm::uvec3& t : surface.triangles) faces->InsertNextCell({t.x, t.y, t.z});
  mesh.SetPoints(points);
  mesh.SetPolys(faces);
}

TriangleMesh read(vtkPolyData& mesh) {
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

}  // namespace

TriangleMesh by_vtk(const TriangleMesh& surface, std::size_t triangles) {
  if (surface.triangles.empty()) return {};
  vtkNew<vtkPolyData> mesh;
  fill(*mesh, surface);
  vtkNew<vtkQuadricDecimation> decimation;
  decimation->SetInputData(mesh);
  decimation->SetTargetReduction(1.0 - static_cast<double>(triangles) /
                                           static_cast<double>(surface.triangles.size()));
  decimation->Update();
  return read(*decimation->GetOutput());
}

}  // namespace nacre

#include "bench/vtk_decimator.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>

#include "bench/vtk_surface.h"

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
  return surface_of(*decimation->GetOutput());
}

}  // namespace nacre

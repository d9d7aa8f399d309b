#include "bench/flying_edges.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkVersion.h>

#include <array>
#include <glm/geometric.hpp>

#include "peers/vtk_image.h"

namespace nacre {
struct FlyingEdges::Pipeline {
  vtkSmartPointer<vtkImageData> image;
  vtkNew<vtkFlyingEdges3D> filter;
};

FlyingEdges::FlyingEdges(const Volume& volume, std::span<const double> values)
    : pipeline_(std::make_unique<Pipeline>()) {
  pipeline_->image = vtkSmartPointer<vtkImageData>::Take(new_vtk_image(volume));
  vtkFlyingEdges3D& filter = *pipeline_->filter;
  filter.SetInputData(pipeline_->image);
  filter.ComputeNormalsOff();
  filter.ComputeGradientsOff();
  filter.ComputeScalarsOff();
  filter.SetNumberOfContours(static_cast<int>(values.size()));
  for (std::size_t k = 0; k < values.size(); ++k) {
    filter.SetValue(static_cast<int>(k), values[k]);
  }
}

FlyingEdges::~FlyingEdges() = default;

void FlyingEdges::run() {
  pipeline_->filter->Modified();
  pipeline_->filter->Update();
}

std::size_t FlyingEdges::triangle_count() const {
  return static_cast<std::size_t>(pipeline_->filter->GetOutput()->GetNumberOfPolys());
}

double FlyingEdges::area() const {
  vtkPolyData* output = pipeline_->filter->GetOutput();
  vtkCellArray* polygons = output->GetPolys();
  vtkNew<vtkIdList> triangle;
  double sum = 0.0;
  for (vtkIdType i = 0; i < polygons->GetNumberOfCells(); ++i) {
    polygons->GetCellAtId(i, triangle);
    std::array<glm::dvec3, 3> p;
    for (vtkIdType j = 0; j < 3; ++j) {
      output->GetPoint(triangle->GetId(j), &p[static_cast<std::size_t>(j)].x);
    }
    sum += 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
  }
  return sum;
}

std::string FlyingEdges::version() { return std::string("VTK ") + vtkVersion::GetVTKVersion(); }

}  // namespace nacre

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
#include <cstring>
#include <glm/geometric.hpp>

#include "core/volume_geometry.h"

namespace nacre {
namespace {

int vtk_type(ScalarType type) {
  switch (type) {
    case ScalarType::U8: return VTK_UNSIGNED_CHAR;
    case ScalarType::I8: return VTK_SIGNED_CHAR;
    case ScalarType::U16: return VTK_UNSIGNED_SHORT;
    case ScalarType::I16: return VTK_SHORT;
    case ScalarType::U32: return VTK_UNSIGNED_INT;
    case ScalarType::I32: return VTK_INT;
    case ScalarType::F32: return VTK_FLOAT;
    case ScalarType::F64: break;
  }
  return VTK_DOUBLE;
}

vtkSmartPointer<vtkImageData> image_of(const Volume& volume) {
  const glm::dvec3 spacing = spacing_mm(volume.world_from_voxel);
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(static_cast<int>(volume.dims.x), static_cast<int>(volume.dims.y),
                       static_cast<int>(volume.dims.z));
  image->SetSpacing(spacing.x, spacing.y, spacing.z);
  image->AllocateScalars(vtk_type(volume.type), 1);
  std::memcpy(image->GetScalarPointer(), volume.samples.data(), volume.samples.size());
  return image;
}

}  // namespace

struct FlyingEdges::Pipeline {
  vtkSmartPointer<vtkImageData> image;
  vtkNew<vtkFlyingEdges3D> filter;
};

FlyingEdges::FlyingEdges(const Volume& volume, std::span<const double> values)
    : pipeline_(std::make_unique<Pipeline>()) {
  pipeline_->image = image_of(volume);
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

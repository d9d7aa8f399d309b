#include "peers/vtk_image.h"

#include <vtkImageData.h>

#include <cstring>

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

}  // namespace

vtkImageData* new_vtk_image(const Volume& volume) {
  const glm::dvec3 spacing = spacing_mm(volume.world_from_voxel);
  vtkImageData* image = vtkImageData::New();
  image->SetDimensions(static_cast<int>(volume.dims.x), static_cast<int>(volume.dims.y),
                       static_cast<int>(volume.dims.z));
  image->SetSpacing(spacing.x, spacing.y, spacing.z);
  image->AllocateScalars(vtk_type(volume.type), 1);
  std::memcpy(image->GetScalarPointer(), volume.samples.data(), volume.samples.size());
  return image;
}

}  // namespace nacre

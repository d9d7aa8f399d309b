#pragma once

#include "core/volume.h"

class vtkImageData;

namespace nacre {

/// A volume's stored samples as VTK has them, on axes of its own: origin 0, the volume's spacings.
///
/// @return  a copy, owned by the caller (for `vtkSmartPointer::Take`)
vtkImageData* new_vtk_image(const Volume& volume);

}  // namespace nacre

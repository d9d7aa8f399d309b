#pragma once

#include <memory>

#include "core/triangle_mesh.h"
#include "core/volume.h"

namespace nacre {

/// A volume as VTK contours and decimates it: vtkFlyingEdges3D and vtkQuadricDecimation, their
/// defaults otherwise, without normals, gradients or scalars.
class VtkContour {
 public:
  explicit VtkContour(const Volume& volume);
  ~VtkContour();
  VtkContour(const VtkContour&) = delete;
  VtkContour& operator=(const VtkContour&) = delete;

  /// The surface at a value of the volume's, open at its border, on axes of the volume's own. May
  /// be called from several threads.
  /// @param part  of the triangles to leave
  TriangleMesh decimated(double value, double part) const;

 private:
  struct Image;
  std::unique_ptr<Image> image_;
};

}  // namespace nacre

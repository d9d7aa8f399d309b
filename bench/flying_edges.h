#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "core/volume.h"

namespace nacre {

/// VTK's vtkFlyingEdges3D over a volume's stored samples, without normals, gradients or scalars:
/// points and triangles, as marching cubes here. Threads are VTK's own choice (the environment's
/// VTK_SMP_BACKEND_IN_USE names another).
class FlyingEdges {
 public:
  /// @param values  contour values, in stored samples
  FlyingEdges(const Volume& volume, std::span<const double> values);
  ~FlyingEdges();
  FlyingEdges(const FlyingEdges&) = delete;
  FlyingEdges& operator=(const FlyingEdges&) = delete;

  /// Contours anew.
  void run();

  std::size_t triangle_count() const;
  double area() const;

  static std::string version();

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace nacre

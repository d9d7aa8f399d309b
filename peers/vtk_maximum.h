#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/camera.h"
#include "core/emission.h"
#include "core/image.h"
#include "core/volume.h"

namespace nacre {

/// Which of VTK's ray casters.
enum class VtkCaster {
  FixedPoint,  ///< vtkFixedPointVolumeRayCastMapper: threads of the processor, 15-bit arithmetic
  Gpu,         ///< vtkOpenGLGPUVolumeRayCastMapper, in whatever OpenGL EGL opens
};

/// "fixed", "gpu".
std::string_view name(VtkCaster caster) noexcept;

/// The caster of that name, if there is one.
std::optional<VtkCaster> vtk_caster(std::string_view name) noexcept;

/// How VTK samples a ray.
struct VtkSampling {
  VtkCaster caster = VtkCaster::FixedPoint;
  double step = 0.5;  ///< between samples, in mean spacings of the volume; positive
};

/// Maximum projections of a volume by VTK: trilinear samples along each ray, the largest of which
/// goes through the emission map. Nothing is adapted to a frame rate: one ray a pixel, the same
/// distance between samples everywhere.
class VtkMaximum {
 public:
  /// @param size    of the pictures, pixels
  /// @throws Error  Unsupported for values that fall where stored samples rise
  VtkMaximum(const Volume& volume, const EmissionMap& emission, glm::ivec2 size);
  ~VtkMaximum();
  VtkMaximum(const VtkMaximum&) = delete;
  VtkMaximum& operator=(const VtkMaximum&) = delete;

  /// The picture, emission as VTK has it: in steps of 1/32767 (fixed point) or 1/255 (GPU). The
  /// fixed-point caster's own picture is taken, without drawing it into a window by OpenGL.
  /// @pre camera.size is that of the constructor
  /// @throws Error  BadArgument for a step that is not positive; Unsupported where the GPU's caster
  ///                finds no EGL context
  Image draw(const Camera& camera, const VtkSampling& sampling);

  /// "VTK 9.1.0, 2 threads", "VTK 9.1.0, llvmpipe (...)"; what the GPU's caster draws with is
  /// known after its first picture.
  std::string device_name(VtkCaster caster) const;

  /// Of all of VTK; 0: as many as the machine has.
  static void set_threads(int threads);

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace nacre

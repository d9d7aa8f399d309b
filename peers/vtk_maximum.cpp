#include "peers/vtk_maximum.h"

#include <fmt/core.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFixedPointRayCastImage.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiThreader.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVersion.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/error.h"
#include "core/volume_geometry.h"
#include "peers/vtk_image.h"
#include "peers/vtk_window.h"
#include "render/gl/backends.h"

namespace nacre {
namespace {

double mean_spacing_mm(const Volume& volume) {
  const glm::dvec3 spacing = spacing_mm(volume.world_from_voxel);
  return (spacing.x + spacing.y + spacing.z) / 3.0;
}

void check_rising(const Volume& volume) {
  if (volume.slope > 0.0) return;
  throw Error(ErrorCode::Unsupported,
              fmt::format("VTK's ray casters: found values of slope {}, expected a positive one: "
                          "they take the maximum of the stored samples",
                          volume.slope));
}

/// Gray that follows the emission map over stored samples, fully opaque.
vtkSmartPointer<vtkVolumeProperty> property_of(const Volume& volume, const EmissionMap& emission) {
  vtkNew<vtkColorTransferFunction> color;
  for (const EmissionKnot& knot : emission.knots()) {
    const double stored = (knot.value - volume.intercept) / volume.slope;
    color->AddRGBPoint(stored, knot.emission, knot.emission, knot.emission);
  }
  vtkNew<vtkPiecewiseFunction> opaque;
  const double lo = (emission.lo() - volume.intercept) / volume.slope;
  const double hi = (emission.hi() - volume.intercept) / volume.slope;
  opaque->AddPoint(lo, 1.0);
  opaque->AddPoint(hi, 1.0);
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetColor(color);
  property->SetScalarOpacity(opaque);
  property->SetInterpolationTypeToLinear();
  property->ShadeOff();
  return property;
}

/// From the image's own axes to the patient's.
vtkSmartPointer<vtkMatrix4x4> world_from_image(const Volume& volume) {
  const glm::dvec3 spacing = spacing_mm(volume.world_from_voxel);
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const double scale = column < 3 ? spacing[column] : 1.0;
      matrix->SetElement(row, column, volume.world_from_voxel[column][row] / scale);
    }
  }
  return matrix;
}

void place(vtkCamera& vtk, const Camera& camera) {
  const double distance =
      camera.perspective ? camera.eye_distance_mm : 2.0 * camera.sphere.radius_mm;
  const glm::dvec3 eye = camera.target_mm - distance * camera.forward;
  vtk.SetFocalPoint(camera.target_mm.x, camera.target_mm.y, camera.target_mm.z);
  vtk.SetPosition(eye.x, eye.y, eye.z);
  vtk.SetViewUp(camera.up.x, camera.up.y, camera.up.z);
  const int shorter = std::min(camera.size.x, camera.size.y);
  const double half_height = camera.half_extent * camera.size.y / shorter;
  vtk.SetParallelProjection(camera.perspective ? 0 : 1);
  if (camera.perspective) {
    constexpr double kDegrees = 180.0 / 3.14159265358979323846;
    vtk.SetViewAngle(2.0 * std::atan(half_height) * kDegrees);
  } else {
    vtk.SetParallelScale(half_height);
  }
  const double middle = glm::dot(camera.sphere.center_mm - eye, camera.forward);
  const double reach = 1.01 * camera.sphere.radius_mm;
  const double least = 1e-3 * camera.sphere.radius_mm;
  vtk.SetClippingRange(std::max(middle - reach, least), std::max(middle + reach, 2.0 * least));
}

vtkSmartPointer<vtkFixedPointVolumeRayCastMapper> fixed_point_mapper() {
  auto mapper = vtkSmartPointer<vtkFixedPointVolumeRayCastMapper>::New();
  mapper->AutoAdjustSampleDistancesOff();
  mapper->LockSampleDistanceToInputSpacingOff();
  mapper->SetImageSampleDistance(1.0F);
  mapper->IntermixIntersectingGeometryOff();
  return mapper;
}

vtkSmartPointer<vtkGPUVolumeRayCastMapper> gpu_mapper() {
  auto mapper = vtkSmartPointer<vtkGPUVolumeRayCastMapper>::New();
  mapper->AutoAdjustSampleDistancesOff();
  mapper->LockSampleDistanceToInputSpacingOff();
  mapper->SetImageSampleDistance(1.0F);
  mapper->UseJitteringOff();
  return mapper;
}

/// The mapper's own picture, before it is drawn into the window in 8 bits. It covers the part of
/// the window that the volume's box covers, from the lower left corner.
Image fixed_point_picture(vtkFixedPointVolumeRayCastMapper& mapper, glm::ivec2 size) {
  vtkFixedPointRayCastImage* cast = mapper.GetRayCastImage();
  int used[2];
  int memory[2];
  int origin[2];
  cast->GetImageInUseSize(used);
  cast->GetImageMemorySize(memory);
  cast->GetImageOrigin(origin);
  Image picture = make_image(size.x, size.y);
  constexpr float kFull = 32767.0F;
  for (int j = 0; j < used[1]; ++j) {
    const int row = size.y - 1 - (j + origin[1]);
    if (row < 0 || row >= size.y) continue;
    const unsigned short* pixels = cast->GetImage() + std::size_t{4} * memory[0] * j;
    for (int i = 0; i < used[0]; ++i) {
      const int column = i + origin[0];
      if (column < 0 || column >= size.x) continue;
      picture.at(column, row) =
          std::min(static_cast<float>(pixels[4 * std::ptrdiff_t{i}]) / kFull, 1.0F);
    }
  }
  return picture;
}

Image window_picture(vtkRenderWindow& window, glm::ivec2 size) {
  vtkNew<vtkUnsignedCharArray> bytes;
  window.GetPixelData(0, 0, size.x - 1, size.y - 1, 0, bytes);
  Image picture = make_image(size.x, size.y);
  constexpr float kFull = 255.0F;
  for (int j = 0; j < size.y; ++j) {
    for (int i = 0; i < size.x; ++i) {
      const vtkIdType pixel = static_cast<vtkIdType>(size.x) * (size.y - 1 - j) + i;
      picture.at(i, j) = static_cast<float>(bytes->GetValue(3 * pixel)) / kFull;
    }
  }
  return picture;
}

}  // namespace

std::string_view name(VtkCaster caster) noexcept {
  return caster == VtkCaster::FixedPoint ? "fixed" : "gpu";
}

std::optional<VtkCaster> vtk_caster(std::string_view text) noexcept {
  for (const VtkCaster caster : {VtkCaster::FixedPoint, VtkCaster::Gpu}) {
    if (text == name(caster)) return caster;
  }
  return std::nullopt;
}

/// Declared so that the context goes last.
struct VtkMaximum::Pipeline {
  std::optional<OpenBackend> backend;
  std::optional<CurrentContext> current;
  glm::ivec2 size{0, 0};
  double spacing_mm = 1.0;  ///< mean
  vtkSmartPointer<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkVolume> volume;
  vtkSmartPointer<vtkFixedPointVolumeRayCastMapper> fixed = fixed_point_mapper();
  vtkSmartPointer<vtkGPUVolumeRayCastMapper> gpu = gpu_mapper();

  Image draw_fixed(float step_mm);
  Image draw_gpu(float step_mm);
};

/// What the mapper's Render does, but for putting its picture into the window.
Image VtkMaximum::Pipeline::draw_fixed(float step_mm) {
  volume->SetMapper(fixed);
  fixed->SetSampleDistance(step_mm);
  fixed->PerVolumeInitialization(renderer, volume);
  fixed->PerImageInitialization(renderer, volume, 0, nullptr, nullptr, nullptr);
  fixed->PerSubVolumeInitialization(renderer, volume, 0);
  fixed->RenderSubVolume();
  return fixed_point_picture(*fixed, size);
}

Image VtkMaximum::Pipeline::draw_gpu(float step_mm) {
  if (!backend) {
    backend = open_backend(Backend::Egl);
    current.emplace(*backend->context);
  }
  volume->SetMapper(gpu);
  gpu->SetSampleDistance(step_mm);
  window->Render();
  return window_picture(*window, size);
}

VtkMaximum::VtkMaximum(const Volume& volume, const EmissionMap& emission, glm::ivec2 size) {
  check_rising(volume);
  pipeline_ = std::make_unique<Pipeline>();
  Pipeline& p = *pipeline_;
  p.size = size;
  p.spacing_mm = mean_spacing_mm(volume);
  const auto image = vtkSmartPointer<vtkImageData>::Take(new_vtk_image(volume));
  for (vtkVolumeMapper* mapper :
       {static_cast<vtkVolumeMapper*>(p.fixed.Get()), static_cast<vtkVolumeMapper*>(p.gpu.Get())}) {
    mapper->SetInputData(image);
    mapper->SetBlendModeToMaximumIntensity();
  }
  p.volume->SetProperty(property_of(volume, emission));
  p.volume->SetUserMatrix(world_from_image(volume));
  p.renderer->SetBackground(0.0, 0.0, 0.0);
  p.renderer->AddVolume(p.volume);
  p.window = vtkSmartPointer<vtkRenderWindow>::Take(new_vtk_window(size.x, size.y));
  p.window->AddRenderer(p.renderer);
}

VtkMaximum::~VtkMaximum() {
  if (pipeline_->current) pipeline_->window->Finalize();
}

Image VtkMaximum::draw(const Camera& camera, const VtkSampling& sampling) {
  if (!(sampling.step > 0.0) || !std::isfinite(sampling.step)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("sample distance: found {}, expected a positive number of voxels",
                            sampling.step));
  }
  Pipeline& p = *pipeline_;
  place(*p.renderer->GetActiveCamera(), camera);
  const auto step_mm = static_cast<float>(sampling.step * p.spacing_mm);
  return sampling.caster == VtkCaster::Gpu ? p.draw_gpu(step_mm) : p.draw_fixed(step_mm);
}

std::string VtkMaximum::device_name(VtkCaster caster) const {
  const std::string version = fmt::format("VTK {}", vtkVersion::GetVTKVersion());
  if (caster == VtkCaster::FixedPoint) {
    return fmt::format("{}, {} threads", version, pipeline_->fixed->GetNumberOfThreads());
  }
  return pipeline_->backend ? fmt::format("{}, {}", version, pipeline_->backend->info.renderer)
                            : version;
}

void VtkMaximum::set_threads(int threads) {
  if (threads > 0) vtkMultiThreader::SetGlobalMaximumNumberOfThreads(threads);
}

}  // namespace nacre

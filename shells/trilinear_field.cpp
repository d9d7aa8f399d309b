#include "shells/trilinear_field.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "core/error.h"

namespace nacre {
namespace {

// Surfaces are stored in float: a vertex of the border plane is this close to it, in voxels.
constexpr double kOnBorder = 1e-3;

/// A coordinate's two samples and the weight of the second.
struct Cell {
  std::size_t lower;
  std::size_t upper;
  double weight;
};

Cell cell_of(double x, std::int64_t size) noexcept {
  // Written so that NaN becomes 0.
  const double inside = x > 0.0 ? std::min(x, static_cast<double>(size - 1)) : 0.0;
  const double lower =
      std::min(std::floor(inside), static_cast<double>(std::max<std::int64_t>(size - 2, 0)));
  const auto index = static_cast<std::size_t>(lower);
  return {index, size > 1 ? index + 1 : index, inside - lower};
}

double mix(double a, double b, double s) noexcept { return a + (b - a) * s; }

}  // namespace

TrilinearField::TrilinearField(const Volume& volume)
    : volume_(volume),
      box_(voxel_box(volume.dims)),
      value_(visit_scalar_type(volume.type, [](auto zero) { return &value_of<decltype(zero)>; })) {
  const double handed = handedness(volume.world_from_voxel);
  if (!std::isfinite(handed) || handed == 0.0) {
    throw Error(ErrorCode::BadArgument, "volume: found a singular matrix, expected a regular one");
  }
  // The translation never enters: a volume far from the origin loses nothing.
  glm::dmat4 local_from_voxel(glm::dmat3(volume.world_from_voxel));
  const glm::dvec3 center = 0.5 * (box_.lo + box_.hi);
  local_from_voxel[3] = glm::dvec4(-glm::dvec3(local_from_voxel * glm::dvec4(center, 0.0)), 1.0);
  voxel_from_local_ = glm::inverse(local_from_voxel);
}

template <class T>
double TrilinearField::value_of(const TrilinearField& field, const glm::dvec3& p) noexcept {
  const Volume& volume = field.volume_;
  const T* samples = samples_as<T>(volume).data();
  const Cell x = cell_of(p.x, volume.dims.x);
  const Cell y = cell_of(p.y, volume.dims.y);
  const Cell z = cell_of(p.z, volume.dims.z);
  const auto nx = static_cast<std::size_t>(volume.dims.x);
  const auto ny = static_cast<std::size_t>(volume.dims.y);
  const auto along_x = [&](std::size_t j, std::size_t k) {
    const T* row = samples + nx * (j + ny * k);
    return mix(static_cast<double>(row[x.lower]), static_cast<double>(row[x.upper]), x.weight);
  };
  const double near = mix(along_x(y.lower, z.lower), along_x(y.upper, z.lower), y.weight);
  const double far = mix(along_x(y.lower, z.upper), along_x(y.upper, z.upper), y.weight);
  return volume.slope * mix(near, far, z.weight) + volume.intercept;
}

double LevelError::operator()(const glm::dvec3& p_mm) const noexcept {
  const glm::dvec3 p = field_.voxel_from_local(p_mm);
  const double error = emission_(field_.value(p)) - level_;
  if (error <= 0.0) return -error;
  const VoxelBox& box = field_.box();
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] <= box.lo[axis] + kOnBorder || p[axis] >= box.hi[axis] - kOnBorder) return 0.0;
  }
  return error;
}

}  // namespace nacre

#include "shells/trilinear_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vector_relational.hpp>

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
      within_{box_.lo + kOnBorder, box_.hi - kOnBorder},
      value_(visit_scalar_type(volume.type, [](auto zero) { return &value_of<decltype(zero)>; })),
      sample_(
          visit_scalar_type(volume.type, [](auto zero) { return &sample_of<decltype(zero)>; })) {
  const double handed = handedness(volume.world_from_voxel);
  if (!std::isfinite(handed) || handed == 0.0) {
    throw Error(ErrorCode::BadArgument, "volume: found a singular matrix, expected a regular one");
  }
  voxel_from_local_ = nacre::voxel_from_local(volume.dims, volume.world_from_voxel);
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

template <class T>
ValueAndGradient TrilinearField::sample_of(const TrilinearField& field,
                                           const glm::dvec3& p) noexcept {
  const Volume& volume = field.volume_;
  const T* samples = samples_as<T>(volume).data();
  const Cell x = cell_of(p.x, volume.dims.x);
  const Cell y = cell_of(p.y, volume.dims.y);
  const Cell z = cell_of(p.z, volume.dims.z);
  const auto nx = static_cast<std::size_t>(volume.dims.x);
  const auto ny = static_cast<std::size_t>(volume.dims.y);
  // Along x first: the value and the slope of each of the cell's four edges.
  const auto edge = [&](std::size_t j, std::size_t k) {
    const T* row = samples + nx * (j + ny * k);
    const auto a = static_cast<double>(row[x.lower]);
    const double slope = static_cast<double>(row[x.upper]) - a;
    return glm::dvec2(a + slope * x.weight, slope);
  };
  const glm::dvec2 e00 = edge(y.lower, z.lower);
  const glm::dvec2 e10 = edge(y.upper, z.lower);
  const glm::dvec2 e01 = edge(y.lower, z.upper);
  const glm::dvec2 e11 = edge(y.upper, z.upper);
  const glm::dvec2 near = e00 + (e10 - e00) * y.weight;
  const glm::dvec2 far = e01 + (e11 - e01) * y.weight;
  const glm::dvec2 at = near + (far - near) * z.weight;
  const double along_y = mix(e10.x - e00.x, e11.x - e01.x, z.weight);
  return {volume.slope * at.x + volume.intercept,
          volume.slope * glm::dvec3(at.y, along_y, far.x - near.x)};
}

bool TrilinearField::is_on_border(const glm::dvec3& p, int axis) const noexcept {
  return p[axis] <= within_.lo[axis] || p[axis] >= within_.hi[axis];
}

bool TrilinearField::is_on_border(const glm::dvec3& p) const noexcept { return !is_within(p); }

bool TrilinearField::is_outside(const glm::dvec3& p) const noexcept {
  return glm::any(glm::lessThan(p, box_.lo - kOnBorder)) ||
         glm::any(glm::greaterThan(p, box_.hi + kOnBorder));
}

/// A gradient without its parts across the border planes that p lies in.
glm::dvec3 TrilinearField::along_border(const glm::dvec3& p, glm::dvec3 gradient) const noexcept {
  const glm::dmat3 normals = glm::transpose(glm::dmat3(voxel_from_local_));  // of the planes
  std::array<glm::dvec3, 3> fixed;                                           // orthonormal
  std::size_t count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_on_border(p, axis)) continue;
    glm::dvec3 normal = normals[axis];
    for (std::size_t i = 0; i < count; ++i) normal -= glm::dot(normal, fixed[i]) * fixed[i];
    fixed[count++] = glm::normalize(normal);
    gradient -= glm::dot(gradient, fixed[count - 1]) * fixed[count - 1];
  }
  return gradient;
}

double LevelError::operator()(const glm::dvec3& p_mm) const noexcept {
  const glm::dvec3 p = field_.voxel_from_local(p_mm);
  const double error = emission_(field_.value(p)) - level_;
  if (error <= 0.0) return -error;
  return field_.is_on_border(p) ? 0.0 : error;
}

}  // namespace nacre

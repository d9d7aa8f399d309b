#include "tests/support/fine_march.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace nacre::testing {

FineMarch::FineMarch(const Volume& volume, const EmissionMap& emission, double step_voxels)
    : volume_(volume), emission_(emission), voxel_from_world_(inverse(volume.world_from_voxel)) {
  double smallest = glm::length(glm::dvec3(volume.world_from_voxel[0]));
  for (int axis = 1; axis < 3; ++axis) {
    smallest = std::min(smallest, glm::length(glm::dvec3(volume.world_from_voxel[axis])));
  }
  step_mm_ = step_voxels * smallest;
}

double FineMarch::stored(std::int64_t x, std::int64_t y, std::int64_t z) const {
  const auto index = static_cast<std::size_t>(x + volume_.dims.x * (y + volume_.dims.y * z));
  return visit_samples(volume_,
                       [index](auto samples) { return static_cast<double>(samples[index]); });
}

double FineMarch::emission_at(const glm::dvec3& p_mm) const {
  const glm::dvec3 p(voxel_from_world_ * glm::dvec4(p_mm, 1.0));
  std::int64_t lo[3];
  std::int64_t hi[3];
  double part[3];
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t last = volume_.dims[axis] - 1;
    const double half = last == 0 ? 0.5 : 0.0;  // one sample spans one spacing
    if (p[axis] < -half || p[axis] > static_cast<double>(last) + half) return 0.0;
    const double clamped = std::clamp(p[axis], 0.0, static_cast<double>(last));
    lo[axis] = std::min(static_cast<std::int64_t>(clamped), std::max<std::int64_t>(last - 1, 0));
    hi[axis] = std::min(lo[axis] + 1, last);
    part[axis] = clamped - static_cast<double>(lo[axis]);
  }
  double value = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const bool x = (corner & 1) != 0;
    const bool y = (corner & 2) != 0;
    const bool z = (corner & 4) != 0;
    const double weight =
        (x ? part[0] : 1 - part[0]) * (y ? part[1] : 1 - part[1]) * (z ? part[2] : 1 - part[2]);
    if (weight == 0.0) continue;
    value += weight * stored(x ? hi[0] : lo[0], y ? hi[1] : lo[1], z ? hi[2] : lo[2]);
  }
  return emission_(volume_.slope * value + volume_.intercept);
}

double FineMarch::weighted_emission_at(const glm::dvec3& p_mm, const Weight& weight) const {
  const double emission = emission_at(p_mm);
  return emission > 0.0 && weight ? emission * weight(p_mm) : emission;
}

double FineMarch::max_emission(const Ray& ray, double t_begin_mm, double t_end_mm,
                               const Weight& weight) const {
  double best = 0.0;
  for (double t = t_begin_mm; t <= t_end_mm; t += step_mm_) {
    best = std::max(best, weighted_emission_at(ray.origin_mm + t * ray.direction, weight));
  }
  return best;
}

double FineMarch::emission_integral(const Ray& ray, double t_begin_mm, double t_end_mm,
                                    const Weight& weight) const {
  double sum = 0.0;
  for (double t = t_begin_mm + 0.5 * step_mm_; t < t_end_mm; t += step_mm_) {
    sum += weighted_emission_at(ray.origin_mm + t * ray.direction, weight);
  }
  return sum * step_mm_;
}

}  // namespace nacre::testing

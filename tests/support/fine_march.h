#pragma once

#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/camera.h"
#include "core/emission.h"
#include "core/volume.h"

namespace nacre::testing {

/// An independent opinion on what a ray sees: samples the trilinear field at even steps. It shares
/// nothing with the exact walk but the volume and the ray.
class FineMarch {
 public:
  /// Of a point in LPS mm; a cue. Empty: 1.
  using Weight = std::function<double(const glm::dvec3& p_mm)>;

  /// @param step_voxels  distance between samples, in units of the smallest spacing
  FineMarch(const Volume& volume, const EmissionMap& emission, double step_voxels);

  /// Largest sampled emission along the ray for t in [t_begin, t_end] mm, times the weight there.
  double max_emission(const Ray& ray, double t_begin_mm, double t_end_mm,
                      const Weight& weight = {}) const;

  /// The midpoint rule for the integral of emission times weight, emission * mm.
  double emission_integral(const Ray& ray, double t_begin_mm, double t_end_mm,
                           const Weight& weight = {}) const;

 private:
  /// T(value) at a point in LPS mm; 0 outside the volume's box.
  double emission_at(const glm::dvec3& p_mm) const;
  double weighted_emission_at(const glm::dvec3& p_mm, const Weight& weight) const;
  double stored(std::int64_t x, std::int64_t y, std::int64_t z) const;

  const Volume& volume_;
  const EmissionMap& emission_;
  glm::dmat4 voxel_from_world_;
  double step_mm_;
};

}  // namespace nacre::testing

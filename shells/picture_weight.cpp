#include "shells/picture_weight.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace nacre {

double mean_slope(const TriangleMesh& surface, const SurfaceField& field) {
  double sum = 0.0;
  double twice_area = 0.0;
  for (const glm::uvec3& t : surface.triangles) {
    const glm::dvec3 a(surface.positions[t.x]);
    const glm::dvec3 b(surface.positions[t.y]);
    const glm::dvec3 c(surface.positions[t.z]);
    const double slope = glm::length(field((a + b + c) / 3.0).gradient);
    if (!(slope > 0.0)) continue;
    const double weight = glm::length(glm::cross(b - a, c - a));
    sum += weight * slope;
    twice_area += weight;
  }
  return twice_area > 0.0 ? sum / twice_area : 0.0;
}

FieldSample PictureWeight::operator()(const glm::dvec3& p_mm) const noexcept {
  const FieldSample at = field_(p_mm);
  if (!(squared_mean_slope_ > 0.0)) return at;
  double weight = kMostWeight;
  if (std::abs(at.error) <= tolerance_) {
    const double ratio = squared_mean_slope_ / glm::dot(at.gradient, at.gradient);
    weight = std::clamp(kMeanWeight * std::sqrt(std::sqrt(ratio)), 1.0, kMostWeight);
  }
  return {weight * at.error, weight * at.gradient};
}

}  // namespace nacre

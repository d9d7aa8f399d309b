#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace nacre {

/// Squared distance of a point to the segment ab, which may be a point.
inline double squared_distance_to_segment(const glm::dvec3& p, const glm::dvec3& a,
                                          const glm::dvec3& b) noexcept {
  const glm::dvec3 ab = b - a;
  const double length = glm::dot(ab, ab);
  const double s = length > 0.0 ? std::clamp(glm::dot(p - a, ab) / length, 0.0, 1.0) : 0.0;
  const glm::dvec3 d = p - (a + s * ab);
  return glm::dot(d, d);
}

/// Squared distance of a point to the triangle abc, which may be degenerate.
inline double squared_distance_to_triangle(const glm::dvec3& p, const glm::dvec3& a,
                                           const glm::dvec3& b, const glm::dvec3& c) noexcept {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double squared_normal = glm::dot(normal, normal);
  // Above the triangle: the point lies on the inner side of all three edges.
  const bool above = squared_normal > 0.0 && glm::dot(glm::cross(b - a, p - a), normal) >= 0.0 &&
                     glm::dot(glm::cross(c - b, p - b), normal) >= 0.0 &&
                     glm::dot(glm::cross(a - c, p - c), normal) >= 0.0;
  if (above) {
    const double height = glm::dot(p - a, normal);
    return height * height / squared_normal;
  }
  return std::min({squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, b, c),
                   squared_distance_to_segment(p, c, a)});
}

}  // namespace nacre

#include "shells/field_quadrics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace nacre {
namespace {

constexpr double kDamping = 1e-3;  // of a quadric, as a part of its mean eigenvalue
// Of the quadric's error: shorter edges go first where it says nothing.
constexpr double kLengthCost = 1e-4;

/// A triangle's plane, weighted for one of its corners.
Quadric plane_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                 const SurfaceField& field, double spacing_mm) {
  const glm::dvec3 twice_area = glm::cross(b - a, c - a);
  const double area = 0.5 * glm::length(twice_area);
  const glm::dvec3 center = (a + b + c) / 3.0;
  FieldSample at{0.0, glm::dvec3(0.0)};
  if (field) at = field(center);
  if (at.gradient == glm::dvec3(0.0) && area > 0.0) {
    at = {0.0, twice_area / (2.0 * area * spacing_mm)};
  }
  Quadric plane;
  plane.add(at.gradient, at.error - glm::dot(at.gradient, center), area / 3.0);
  return plane;
}

}  // namespace

FieldQuadrics::FieldQuadrics(const ClosedMesh& mesh, std::span<const glm::dvec3> positions,
                             const SurfaceField& field, double spacing_mm)
    : quadrics_(mesh.vertex_count()) {
  for (std::size_t face = 0; face < mesh.triangle_count(); ++face) {
    const glm::uvec3 t = mesh.triangle(face);
    const Quadric plane =
        plane_of(positions[t.x], positions[t.y], positions[t.z], field, spacing_mm);
    for (const std::uint32_t v : {t.x, t.y, t.z}) quadrics_[v] += plane;
  }
}

CollapseTarget FieldQuadrics::target(const ClosedMesh& mesh, std::span<const glm::dvec3> positions,
                                     std::uint32_t h) const {
  const std::uint32_t u = mesh.from(h);
  const std::uint32_t v = mesh.to(h);
  Quadric quadric = quadrics_[u];
  quadric += quadrics_[v];
  const glm::dvec3 middle = 0.5 * (positions[u] + positions[v]);
  const glm::dvec3 edge = positions[v] - positions[u];
  const double squared_length = glm::dot(edge, edge);
  glm::dvec3 step = quadric.step_to_least(middle, kDamping);
  const double squared_step = glm::dot(step, step);
  if (squared_step > squared_length) step *= std::sqrt(squared_length / squared_step);
  const double trace = quadric.diagonal.x + quadric.diagonal.y + quadric.diagonal.z;
  // Rounding makes small errors negative.
  const double error = std::max(quadric(middle + step), 0.0);
  const double cost = error + kLengthCost * squared_length * trace;
  return {middle + step, error, cost, quadric.weight};
}

}  // namespace nacre

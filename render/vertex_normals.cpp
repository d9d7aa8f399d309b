#include "render/vertex_normals.h"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace nacre {
namespace {

/// Angle between two edges, whatever their lengths: 0 if one has none.
double angle_rad(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

std::vector<glm::vec3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
  for (const glm::uvec3& triangle : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[triangle.x]);
    const glm::dvec3 b(mesh.positions[triangle.y]);
    const glm::dvec3 c(mesh.positions[triangle.z]);
    const glm::dvec3 across = glm::cross(b - a, c - a);
    const double length = glm::length(across);
    if (!(length > 0.0)) continue;  // no area, no normal
    const glm::dvec3 normal = across / length;
    sums[triangle.x] += angle_rad(b - a, c - a) * normal;
    sums[triangle.y] += angle_rad(c - b, a - b) * normal;
    sums[triangle.z] += angle_rad(a - c, b - c) * normal;
  }
  std::vector<glm::vec3> normals(sums.size(), glm::vec3(0.0F));
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double length = glm::length(sums[i]);
    if (length > 0.0) normals[i] = glm::vec3(sums[i] / length);
  }
  return normals;
}

}  // namespace nacre

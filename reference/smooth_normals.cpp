#include "reference/smooth_normals.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace nacre {

std::vector<glm::dvec3> smooth_normals(const TriangleMesh& mesh) {
  std::vector<glm::dvec3> normals(mesh.positions.size(), glm::dvec3(0.0));
  for (const glm::uvec3& triangle : mesh.triangles) {
    const std::array<glm::dvec3, 3> corners{mesh.positions[triangle.x], mesh.positions[triangle.y],
                                            mesh.positions[triangle.z]};
    const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double twice_area = glm::length(across);
    if (!(twice_area > 0.0)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 ahead = corners[(i + 1) % 3] - corners[i];
      const glm::dvec3 back = corners[(i + 2) % 3] - corners[i];
      const double angle = std::atan2(twice_area, glm::dot(ahead, back));
      normals[triangle[static_cast<int>(i)]] += (angle / twice_area) * across;
    }
  }
  for (glm::dvec3& normal : normals) {
    const double length = glm::length(normal);
    if (length > 0.0) normal /= length;
  }
  return normals;
}

}  // namespace nacre

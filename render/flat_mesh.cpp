#include "render/flat_mesh.h"

#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>

namespace nacre {
namespace {

glm::vec3 normal_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 across = glm::cross(b - a, c - a);
  const double length = glm::length(across);
  return length > 0.0 ? glm::vec3(across / length) : glm::vec3(0.0F);
}

/// The triangle turned so that its last vertex is one that no other triangle owns, if it has any.
glm::uvec3 turned_to_a_free_vertex(const glm::uvec3& t, const std::vector<bool>& owned) {
  if (!owned[t.z]) return t;
  if (!owned[t.x]) return {t.y, t.z, t.x};
  if (!owned[t.y]) return {t.z, t.x, t.y};
  return t;
}

}  // namespace

FlatMesh flat_mesh(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles) {
  FlatMesh mesh{{positions.begin(), positions.end()},
                std::vector<glm::vec3>(positions.size(), glm::vec3(0.0F)),
                {}};
  mesh.triangles.reserve(triangles.size());
  std::vector<bool> owned(positions.size(), false);
  for (const glm::uvec3& given : triangles) {
    glm::uvec3 triangle = turned_to_a_free_vertex(given, owned);
    if (owned[triangle.z]) {
      mesh.positions.push_back(mesh.positions[triangle.z]);
      mesh.normals.emplace_back(0.0F);
      triangle.z = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    } else {
      owned[triangle.z] = true;
    }
    mesh.normals[triangle.z] =
        normal_of(glm::dvec3(mesh.positions[triangle.x]), glm::dvec3(mesh.positions[triangle.y]),
                  glm::dvec3(mesh.positions[triangle.z]));
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace nacre

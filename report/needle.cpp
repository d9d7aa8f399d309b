#include "report/needle.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>

namespace nacre {
namespace {

constexpr unsigned kSides = 16;

static_assert(std::endian::native == std::endian::little, "STL is little-endian");

template <class Value>
void append(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

}  // namespace

TriangleMesh needle(const BoundingSphere& sphere) {
  const glm::dvec3 along = glm::normalize(glm::dvec3(-0.45, 0.8, -0.4));
  const glm::dvec3 across = glm::normalize(glm::cross(along, glm::dvec3(0.0, 0.0, 1.0)));
  const glm::dvec3 upwards = glm::cross(across, along);
  const double thickness = sphere.radius_mm / 30.0;
  const glm::dvec3 begin = sphere.center_mm - 0.9 * sphere.radius_mm * along;
  const glm::dvec3 end = sphere.center_mm + 0.25 * sphere.radius_mm * along;
  TriangleMesh mesh;
  for (unsigned i = 0; i < kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides;
    const glm::dvec3 out = 0.5 * thickness * (std::cos(angle) * across + std::sin(angle) * upwards);
    mesh.positions.emplace_back(begin + out);
    mesh.positions.emplace_back(end + out);
  }
  mesh.positions.emplace_back(begin);
  mesh.positions.emplace_back(end + thickness * along);
  const unsigned back = 2 * kSides;
  const unsigned tip = back + 1;
  for (unsigned i = 0; i < kSides; ++i) {
    const unsigned a = 2 * i;
    const unsigned b = 2 * ((i + 1) % kSides);
    mesh.triangles.emplace_back(a, b, b + 1);
    mesh.triangles.emplace_back(a, b + 1, a + 1);
    mesh.triangles.emplace_back(back, b, a);
    mesh.triangles.emplace_back(tip, a + 1, b + 1);
  }
  return mesh;
}

std::string stl_bytes(const TriangleMesh& mesh) {
  std::string bytes = "needle of a Nacre report, LPS mm";
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const glm::uvec3& triangle : mesh.triangles) {
    const glm::vec3 a = mesh.positions[triangle.x];
    const glm::vec3 b = mesh.positions[triangle.y];
    const glm::vec3 c = mesh.positions[triangle.z];
    append(bytes, glm::normalize(glm::cross(b - a, c - a)));
    for (const glm::vec3& corner : {a, b, c}) append(bytes, corner);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace nacre

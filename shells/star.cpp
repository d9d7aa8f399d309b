#include "shells/star.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace nacre {
namespace {

constexpr double kLeastTurn = 0.25;     // cosine between a triangle's normals before and after
constexpr double kLeastQuality = 0.04;  // height over longest side
constexpr double kSharpest = -0.9;      // cosine between the normals of neighbours

/// Squared height over longest side of a triangle: 0.75 for an equilateral one.
double squared_quality(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                       double squared_twice_area) {
  const auto squared = [](const glm::dvec3& v) { return glm::dot(v, v); };
  const double longest = std::max({squared(b - a), squared(c - b), squared(a - c)});
  return longest > 0.0 ? squared_twice_area / (longest * longest) : 0.0;
}

/// Whether a triangle whose normal was `before` turns too far, or loses its area.
bool turns(const glm::dvec3& before, const glm::dvec3& after) {
  const double aligned = glm::dot(before, after);
  const double squared_after = glm::dot(after, after);
  return !(squared_after > 0.0) || aligned < 0.0 ||
         aligned * aligned < kLeastTurn * kLeastTurn * glm::dot(before, before) * squared_after;
}

/// Whether an edge between triangles of these normals is folded, surface on surface.
bool is_fold(const glm::dvec3& a, const glm::dvec3& b) {
  const double aligned = glm::dot(a, b);
  return aligned < 0.0 &&
         aligned * aligned > kSharpest * kSharpest * glm::dot(a, a) * glm::dot(b, b);
}

glm::dvec3 normal_of(const ClosedMesh& mesh, std::span<const glm::dvec3> positions,
                     std::uint32_t triangle) {
  const glm::uvec3 t = mesh.triangle(triangle);
  return glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
}

/// The half-edge out of the same vertex that follows counter-clockwise.
std::uint32_t counter_clockwise(const ClosedMesh& mesh, std::uint32_t h) {
  return mesh.opposite(ClosedMesh::previous(h));
}

/// Adds the triangles left of the half-edges from `first` up to `end`, all out of one vertex.
void add_fan(const ClosedMesh& mesh, std::span<const glm::dvec3> positions, std::uint32_t first,
             std::uint32_t end, Star& star) {
  const glm::dvec3& apex = positions[mesh.from(first)];
  std::uint32_t h = first;
  do {
    star.ring.push_back(positions[mesh.to(h)]);
    const std::uint32_t beyond = mesh.opposite(ClosedMesh::next(h)) / 3;
    star.triangles.push_back({apex, normal_of(mesh, positions, beyond), h / 3});
    h = counter_clockwise(mesh, h);
  } while (h != end);
}

void add_removed(const ClosedMesh& mesh, std::span<const glm::dvec3> positions, std::uint32_t h,
                 Star& star) {
  star.removed.push_back(
      {positions[mesh.from(h)], positions[mesh.to(h)], positions[mesh.apex(h)], h / 3});
}

void clear(Star& star) {
  star.ring.clear();
  star.triangles.clear();
  star.removed.clear();
}

}  // namespace

void star_of_vertex(const ClosedMesh& mesh, std::span<const glm::dvec3> positions,
                    std::uint32_t vertex, Star& star) {
  clear(star);
  add_fan(mesh, positions, mesh.outgoing(vertex), mesh.outgoing(vertex), star);
}

void star_of_collapse(const ClosedMesh& mesh, std::span<const glm::dvec3> positions,
                      std::uint32_t h, Star& star) {
  clear(star);
  const std::uint32_t o = mesh.opposite(h);
  // About each end, from after the one triangle that vanishes up to the other.
  add_fan(mesh, positions, counter_clockwise(mesh, h), ClosedMesh::next(o), star);
  add_fan(mesh, positions, counter_clockwise(mesh, o), ClosedMesh::next(h), star);
  add_removed(mesh, positions, h, star);
  add_removed(mesh, positions, o, star);
}

bool keeps_shape(const Star& star, const glm::dvec3& p) {
  const std::size_t n = star.ring.size();
  glm::dvec3 previous = glm::cross(star.ring[n - 1] - p, star.ring[0] - p);
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec3& a = star.ring[i];
    const glm::dvec3& b = star.after(i);
    const glm::dvec3& was = star.triangles[i].apex_before;
    const glm::dvec3& beyond = star.triangles[i].normal_beyond;
    const glm::dvec3 before = glm::cross(a - was, b - was);
    const glm::dvec3 after = glm::cross(a - p, b - p);
    if (turns(before, after) || is_fold(previous, after) ||
        (is_fold(beyond, after) && !is_fold(beyond, before))) {
      return false;
    }
    const double now = squared_quality(p, a, b, glm::dot(after, after));
    if (now < kLeastQuality * kLeastQuality &&
        now <= squared_quality(was, a, b, glm::dot(before, before))) {
      return false;
    }
    previous = after;
  }
  return true;
}

}  // namespace nacre

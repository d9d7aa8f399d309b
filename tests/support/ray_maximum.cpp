#include "tests/support/ray_maximum.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace nacre::testing {
namespace {

/// A ray through a shared edge must not slip between its triangles.
constexpr double kEdge = 1e-12;

/// Moller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection", both sides.
bool meets(const Ray& ray, bool from_eye, const glm::dvec3& a, const glm::dvec3& b,
           const glm::dvec3& c) {
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const glm::dvec3 p = glm::cross(ray.direction, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0.0) return false;
  const glm::dvec3 from_a = ray.origin_mm - a;
  const double u = glm::dot(from_a, p) / determinant;
  const glm::dvec3 q = glm::cross(from_a, ab);
  const double v = glm::dot(ray.direction, q) / determinant;
  const double t = glm::dot(ac, q) / determinant;
  return u >= -kEdge && v >= -kEdge && u + v <= 1.0 + kEdge && (!from_eye || t > 0.0);
}

bool meets(const Ray& ray, bool from_eye, const TriangleMesh& mesh) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& t) {
    return meets(ray, from_eye, glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]),
                 glm::dvec3(mesh.positions[t.z]));
  });
}

}  // namespace

double ray_maximum(const ShellSet& set, const Ray& ray, bool from_eye, int hidden) {
  const Ray local{ray.origin_mm - set.center_mm, ray.direction};
  double maximum = 0.0;
  for (std::size_t i = set.shells.size(); i-- > 0;) {  // the brightest first: less to try
    const Shell& shell = set.shells[i];
    if (static_cast<int>(i) == hidden || shell.representative <= maximum) continue;
    if (meets(local, from_eye, shell.surface)) maximum = shell.representative;
  }
  return maximum;
}

}  // namespace nacre::testing

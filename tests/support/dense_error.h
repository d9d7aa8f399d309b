#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/vec3.hpp>

#include "core/triangle_mesh.h"

namespace nacre::testing {

using PointError = std::function<double(const glm::dvec3& p)>;

/// Calls `visit(p)` with the points of a triangle's barycentric lattice of `parts` a side, corners
/// and sides included.
template <class Visit>
void visit_lattice(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, int parts,
                   Visit&& visit) {
  for (int i = 0; i <= parts; ++i) {
    for (int j = 0; i + j <= parts; ++j) {
      visit((double(i) * a + double(j) * b + double(parts - i - j) * c) / double(parts));
    }
  }
}

/// Largest error over a surface, each triangle sampled at the same number of parts a side: nothing
/// of how a simplifier samples.
inline double largest_error(const TriangleMesh& mesh, const PointError& error, int parts) {
  double worst = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    visit_lattice(glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]),
                  glm::dvec3(mesh.positions[t.z]), parts,
                  [&](const glm::dvec3& p) { worst = std::max(worst, error(p)); });
  }
  return worst;
}

}  // namespace nacre::testing

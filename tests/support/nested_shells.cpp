#include "tests/support/nested_shells.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace nacre::testing {
namespace {

std::uint32_t index(int i) { return static_cast<std::uint32_t>(i); }

double turn(int part, int parts) { return 2.0 * std::numbers::pi * part / parts; }

}  // namespace

TriangleMesh ball_mesh(const glm::dvec3& center, double radius, int rings) {
  const int around = 2 * rings;
  TriangleMesh mesh;
  mesh.positions.emplace_back(center + glm::dvec3(0, 0, radius));
  for (int ring = 1; ring < rings; ++ring) {
    const double polar = 0.5 * turn(ring, rings);
    for (int k = 0; k < around; ++k) {
      mesh.positions.emplace_back(center +
                                  radius * glm::dvec3(std::sin(polar) * std::cos(turn(k, around)),
                                                      std::sin(polar) * std::sin(turn(k, around)),
                                                      std::cos(polar)));
    }
  }
  mesh.positions.emplace_back(center - glm::dvec3(0, 0, radius));

  const int south = 1 + (rings - 1) * around;
  const auto at = [&](int ring, int k) { return index(1 + ring * around + k % around); };
  for (int k = 0; k < around; ++k) {
    mesh.triangles.emplace_back(0U, at(0, k), at(0, k + 1));
    mesh.triangles.emplace_back(index(south), at(rings - 2, k + 1), at(rings - 2, k));
    for (int ring = 0; ring + 2 < rings; ++ring) {
      mesh.triangles.emplace_back(at(ring, k), at(ring + 1, k), at(ring + 1, k + 1));
      mesh.triangles.emplace_back(at(ring, k), at(ring + 1, k + 1), at(ring, k + 1));
    }
  }
  return mesh;
}

TriangleMesh block_mesh(const glm::dvec3& lo, const glm::dvec3& hi) {
  TriangleMesh mesh;
  for (unsigned corner = 0; corner < 8; ++corner) {
    mesh.positions.emplace_back((corner & 1U) != 0 ? hi.x : lo.x, (corner & 2U) != 0 ? hi.y : lo.y,
                                (corner & 4U) != 0 ? hi.z : lo.z);
  }
  // Counter-clockwise seen from outside.
  for (const glm::uvec4& q :
       {glm::uvec4(0, 4, 6, 2), glm::uvec4(1, 3, 7, 5), glm::uvec4(0, 1, 5, 4),
        glm::uvec4(2, 6, 7, 3), glm::uvec4(0, 2, 3, 1), glm::uvec4(4, 5, 7, 6)}) {
    mesh.triangles.emplace_back(q.x, q.y, q.z);
    mesh.triangles.emplace_back(q.x, q.z, q.w);
  }
  return mesh;
}

TriangleMesh ring_mesh(const glm::dvec3& center, double major_radius, double minor_radius,
                       int rings) {
  TriangleMesh mesh;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < rings; ++j) {
      const double from_axis = major_radius + minor_radius * std::cos(turn(j, rings));
      mesh.positions.emplace_back(center + glm::dvec3(from_axis * std::cos(turn(i, rings)),
                                                      from_axis * std::sin(turn(i, rings)),
                                                      minor_radius * std::sin(turn(j, rings))));
    }
  }
  const auto at = [&](int i, int j) { return index((i % rings) * rings + j % rings); };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < rings; ++j) {
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return mesh;
}

TriangleMesh join(TriangleMesh a, const TriangleMesh& b) {
  const auto offset = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  a.triangles.reserve(a.triangles.size() + b.triangles.size());
  for (const glm::uvec3& triangle : b.triangles) a.triangles.push_back(triangle + offset);
  return a;
}

TriangleMesh scaled(TriangleMesh mesh, float factor) {
  for (glm::vec3& p : mesh.positions) p *= factor;
  return mesh;
}

TriangleMesh two_rings() {
  return join(ring_mesh({}, 25.0, 8.0, 30), ring_mesh({60.0, 0.0, 5.0}, 12.0, 3.0, 20));
}

ShellSet make_set(std::vector<TriangleMesh> surfaces, const glm::dvec3& center_mm) {
  ShellSet set;
  set.center_mm = center_mm;
  const auto count = static_cast<double>(surfaces.size());
  for (TriangleMesh& surface : surfaces) {
    Shell shell;
    const auto k = static_cast<double>(set.shells.size() + 1);
    shell.emission = (k - 0.5) / count;
    shell.value = shell.emission;
    shell.representative = k / count;
    shell.surface = std::move(surface);
    set.shells.push_back(std::move(shell));
  }
  return set;
}

ShellSet nested_balls(int shells, double radius, int rings, const glm::dvec3& center_mm) {
  std::vector<TriangleMesh> surfaces;
  for (int k = 0; k < shells; ++k) {
    surfaces.push_back(ball_mesh({}, radius * (shells - k) / shells, rings));
  }
  return make_set(std::move(surfaces), center_mm);
}

ShellSet mixed_set(const glm::dvec3& center_mm) {
  return make_set({join(ball_mesh({}, 40.0, 10), block_mesh({20, 20, 20}, {50, 45, 60})),
                   ring_mesh({}, 25.0, 8.0, 16), block_mesh({-10, -5, -5}, {20, 5, 10})},
                  center_mm);
}

}  // namespace nacre::testing

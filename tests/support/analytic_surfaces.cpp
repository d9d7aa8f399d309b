#include "tests/support/analytic_surfaces.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <utility>

namespace nacre::testing {
namespace {

/// Vertices of the cube's surface by their place on the grid, shared between sides.
class CubeBuilder {
 public:
  CubeBuilder(float half_side, int cells) : half_side_(half_side), cells_(cells) {}

  /// The side where `axis` is at its far (or near) end.
  void add_side(int axis, bool far) {
    for (int j = 0; j < cells_; ++j) {
      for (int i = 0; i < cells_; ++i) add_square(axis, far, i, j);
    }
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  void add_square(int axis, bool far, int i, int j) {
    std::array<std::uint32_t, 4> corner{vertex(axis, far, i, j), vertex(axis, far, i + 1, j),
                                        vertex(axis, far, i + 1, j + 1),
                                        vertex(axis, far, i, j + 1)};
    if (!far) std::swap(corner[1], corner[3]);
    mesh_.triangles.emplace_back(corner[0], corner[1], corner[2]);
    mesh_.triangles.emplace_back(corner[0], corner[2], corner[3]);
  }

  std::uint32_t vertex(int axis, bool far, int i, int j) {
    std::array<int, 3> place{};
    const auto at = static_cast<std::size_t>(axis);
    place[at] = far ? cells_ : 0;
    place[(at + 1) % 3] = i;
    place[(at + 2) % 3] = j;
    const auto [entry, is_new] =
        vertices_.try_emplace(place, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) {
      const glm::vec3 p(place[0], place[1], place[2]);
      mesh_.positions.push_back(half_side_ * (2.0f * p / static_cast<float>(cells_) - 1.0f));
    }
    return entry->second;
  }

  float half_side_;
  int cells_;
  TriangleMesh mesh_;
  std::map<std::array<int, 3>, std::uint32_t> vertices_;
};

}  // namespace

TriangleMesh cube_surface(float half_side, int cells) {
  CubeBuilder builder(half_side, cells);
  for (int axis = 0; axis < 3; ++axis) {
    builder.add_side(axis, true);
    builder.add_side(axis, false);
  }
  return builder.take();
}

TriangleMesh sphere_surface(float radius, int cells) {
  TriangleMesh mesh = cube_surface(1.0f, cells);
  // Equal angles instead of equal lengths along an axis keep the triangles alike.
  constexpr float kQuarter = std::numbers::pi_v<float> / 4.0f;
  for (glm::vec3& p : mesh.positions) {
    const glm::vec3 even(std::tan(kQuarter * p.x), std::tan(kQuarter * p.y),
                         std::tan(kQuarter * p.z));
    p = radius * glm::normalize(even);
  }
  return mesh;
}

TriangleMesh torus_surface(float major_radius, float minor_radius, int major, int minor) {
  constexpr float kTurn = 2.0f * std::numbers::pi_v<float>;
  TriangleMesh mesh;
  for (int i = 0; i < major; ++i) {
    for (int j = 0; j < minor; ++j) {
      const float u = kTurn * static_cast<float>(i) / static_cast<float>(major);
      const float v = kTurn * static_cast<float>(j) / static_cast<float>(minor);
      const float ring = major_radius + minor_radius * std::cos(v);
      mesh.positions.emplace_back(ring * std::cos(u), ring * std::sin(u),
                                  minor_radius * std::sin(v));
    }
  }
  const auto vertex = [&](int i, int j) {
    return static_cast<std::uint32_t>(i % major * minor + j % minor);
  };
  for (int i = 0; i < major; ++i) {
    for (int j = 0; j < minor; ++j) {
      mesh.triangles.emplace_back(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      mesh.triangles.emplace_back(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  }
  return mesh;
}

TriangleMesh together(TriangleMesh first, const TriangleMesh& second) {
  const auto offset = static_cast<std::uint32_t>(first.positions.size());
  first.positions.insert(first.positions.end(), second.positions.begin(), second.positions.end());
  for (const glm::uvec3& t : second.triangles) first.triangles.push_back(t + offset);
  return first;
}

TriangleMesh moved(TriangleMesh mesh, const glm::vec3& offset) {
  for (glm::vec3& p : mesh.positions) p += offset;
  return mesh;
}

TriangleMesh turned_inside_out(TriangleMesh mesh) {
  for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  return mesh;
}

}  // namespace nacre::testing

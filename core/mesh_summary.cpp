#include "core/mesh_summary.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace nacre {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// For each vertex the first one with its position.
std::vector<std::uint32_t> first_of_position(const std::vector<glm::vec3>& positions) {
  const auto key = [&](std::uint32_t i) {
    const glm::vec3 p = positions[i] + 0.0F;  // -0 becomes 0
    return std::tuple(p.x, p.y, p.z, i);
  };
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> first(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool repeated = i > 0 && positions[order[i]] == positions[order[i - 1]];
    first[order[i]] = repeated ? first[order[i - 1]] : order[i];
  }
  return first;
}

/// Counts edges by how many triangles they have.
void count_edges(std::vector<Edge> edges, MeshSummary& summary) {
  std::sort(edges.begin(), edges.end());
  for (auto begin = edges.begin(); begin != edges.end();) {
    const auto end = std::upper_bound(begin, edges.end(), *begin);
    if (end - begin == 1) ++summary.open_edges;
    if (end - begin > 2) ++summary.non_manifold_edges;
    begin = end;
  }
}

}  // namespace

MeshSummary summarize(const TriangleMesh& mesh) {
  MeshSummary summary;
  summary.triangles = mesh.triangles.size();
  if (mesh.triangles.empty()) return summary;
  const std::vector<std::uint32_t> first = first_of_position(mesh.positions);
  std::vector<std::uint8_t> used(mesh.positions.size(), 0);
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  // Volumes are summed about a point of the mesh, so that one far from the origin keeps its digits.
  const glm::dvec3 apex(mesh.positions[mesh.triangles[0].x]);
  summary.lo = summary.hi = apex;
  for (const glm::uvec3& triangle : mesh.triangles) {
    const std::array<std::uint32_t, 3> corners{first[triangle.x], first[triangle.y],
                                               first[triangle.z]};
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 p(mesh.positions[corners[i]]);
      used[corners[i]] = 1;
      summary.lo = glm::min(summary.lo, p);
      summary.hi = glm::max(summary.hi, p);
    }
    const auto [a, b, c] = corners;
    if (a == b || b == c || c == a) {
      ++summary.without_area;
      continue;
    }
    for (const auto& [from, to] : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
      edges.emplace_back(std::min(from, to), std::max(from, to));
    }
    const auto arm = [&](std::uint32_t i) { return glm::dvec3(mesh.positions[i]) - apex; };
    summary.signed_volume += glm::dot(arm(a), glm::cross(arm(b), arm(c)));
  }
  summary.signed_volume /= 6.0;
  summary.vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
  count_edges(std::move(edges), summary);
  return summary;
}

}  // namespace nacre

#include "tests/support/mesh_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <vector>

namespace nacre::testing {
namespace {

std::uint64_t directed_edge(std::uint32_t from, std::uint32_t to) {
  return (std::uint64_t{from} << 32) | to;
}

void check_edges(const TriangleMesh& mesh, MeshFacts& facts) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) edges.push_back(directed_edge(t[i], t[(i + 1) % 3]));
  }
  std::ranges::sort(edges);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i > 0 && edges[i] == edges[i - 1]) ++facts.repeated_edges;
    const auto opposite = directed_edge(static_cast<std::uint32_t>(edges[i]),
                                        static_cast<std::uint32_t>(edges[i] >> 32));
    const auto range = std::ranges::equal_range(edges, opposite);
    if (range.size() != 1) ++facts.unpaired_edges;
  }
}

void check_triangles(const TriangleMesh& mesh, MeshFacts& facts) {
  facts.least_area = std::numeric_limits<double>::infinity();
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]);
    const glm::dvec3 b(mesh.positions[t.y]);
    const glm::dvec3 c(mesh.positions[t.z]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area = 0.5 * glm::length(normal);
    facts.area += area;
    facts.least_area = std::min(facts.least_area, area);
    facts.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    if (t.x == t.y || t.y == t.z || t.z == t.x || !(area > 0.0)) ++facts.degenerate;
  }
}

std::uint32_t root_of(std::vector<std::uint32_t>& parents, std::uint32_t vertex) {
  while (parents[vertex] != vertex) {
    parents[vertex] = parents[parents[vertex]];
    vertex = parents[vertex];
  }
  return vertex;
}

void check_vertices(const TriangleMesh& mesh, MeshFacts& facts) {
  std::vector<std::uint32_t> parents(mesh.positions.size());
  std::iota(parents.begin(), parents.end(), 0u);
  std::vector<bool> used(mesh.positions.size());
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      used[t[i]] = true;
      parents[root_of(parents, t[i])] = root_of(parents, t.x);
    }
  }
  for (std::uint32_t v = 0; v < parents.size(); ++v) {
    if (!used[v]) ++facts.unused_vertices;
    if (parents[v] == v) ++facts.components;
  }
  if (mesh.positions.empty()) return;
  facts.lo = facts.hi = glm::dvec3(mesh.positions[0]);
  for (const glm::vec3& position : mesh.positions) {
    for (int c = 0; c < 3; ++c) facts.finite = facts.finite && std::isfinite(position[c]);
    facts.lo = glm::min(facts.lo, glm::dvec3(position));
    facts.hi = glm::max(facts.hi, glm::dvec3(position));
  }
}

}  // namespace

MeshFacts facts_of(const TriangleMesh& mesh) {
  MeshFacts facts;
  facts.vertices = mesh.positions.size();
  facts.triangles = mesh.triangles.size();
  check_edges(mesh, facts);
  check_triangles(mesh, facts);
  check_vertices(mesh, facts);
  return facts;
}

std::string flaw_of(const MeshFacts& facts) {
  std::string flaw;
  const auto add = [&flaw](std::size_t count, const char* what) {
    if (count > 0) flaw += std::to_string(count) + " " + what + "; ";
  };
  add(facts.unpaired_edges, "edges without exactly one opposite");
  add(facts.repeated_edges, "repeated directed edges");
  add(facts.degenerate, "degenerate triangles");
  add(facts.unused_vertices, "unused vertices");
  add(facts.finite ? 0 : 1, "mesh that is not finite");
  return flaw;
}

}  // namespace nacre::testing

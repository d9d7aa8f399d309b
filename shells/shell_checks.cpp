#include "shells/shell_checks.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

#include "shells/disjoint_sets.h"

namespace nacre {
namespace {

/// An edge as one triangle runs along it.
struct EdgeUse {
  std::uint32_t low;        ///< the lesser vertex
  std::uint32_t high;       ///< the greater one
  std::uint32_t half_edge;  ///< 3 * triangle + corner it starts from
  bool ascending;

  bool same_edge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

std::vector<EdgeUse> sorted_edge_uses(const TriangleMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t from = t[i];
      const std::uint32_t to = t[(i + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to),
                      static_cast<std::uint32_t>(uses.size()), from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return a.low != b.low     ? a.low < b.low
           : a.high != b.high ? a.high < b.high
                              : a.half_edge < b.half_edge;
  });
  return uses;
}

std::uint32_t next_corner(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// Counts edges by kind, and joins the corners of triangles that share an ordinary edge.
std::size_t check_edges(const TriangleMesh& mesh, ShellReport& report, DisjointSets& corners) {
  const std::vector<EdgeUse> uses = sorted_edge_uses(mesh);
  std::size_t edges = 0;
  for (std::size_t begin = 0; begin < uses.size(); ++edges) {
    std::size_t end = begin;
    std::ptrdiff_t balance = 0;
    for (; end < uses.size() && uses[end].same_edge(uses[begin]); ++end) {
      balance += uses[end].ascending ? 1 : -1;
    }
    const std::size_t count = end - begin;
    if (count % 2 != 0) ++report.open_edges;
    if (count % 2 == 0 && balance != 0) ++report.misoriented_edges;
    if (count > 2) ++report.crowded_edges;
    if (count == 2 && balance == 0) {
      const std::uint32_t a = uses[begin].half_edge;
      const std::uint32_t b = uses[begin + 1].half_edge;
      corners.join(a, next_corner(b));
      corners.join(next_corner(a), b);
    }
    begin = end;
  }
  return edges;
}

/// A vertex is ordinary if all corners at it were joined into one fan.
void check_vertices(const TriangleMesh& mesh, ShellReport& report, DisjointSets& corners) {
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> fan(mesh.positions.size(), kNone);
  std::vector<bool> crowded(mesh.positions.size(), false);
  for (std::size_t corner = 0; corner < 3 * mesh.triangles.size(); ++corner) {
    const std::uint32_t vertex = mesh.triangles[corner / 3][static_cast<int>(corner % 3)];
    const std::uint32_t root = corners.root(static_cast<std::uint32_t>(corner));
    if (fan[vertex] == kNone) {
      fan[vertex] = root;
      ++report.vertices;
    } else if (fan[vertex] != root) {
      crowded[vertex] = true;
    }
  }
  report.crowded_vertices =
      static_cast<std::size_t>(std::count(crowded.begin(), crowded.end(), true));
}

void count_components(const TriangleMesh& mesh, ShellReport& report) {
  DisjointSets vertices(mesh.positions.size());
  for (const glm::uvec3& t : mesh.triangles) {
    vertices.join(t.x, t.y);
    vertices.join(t.y, t.z);
  }
  std::vector<bool> seen(mesh.positions.size(), false);
  for (const glm::uvec3& t : mesh.triangles) {
    const std::uint32_t root = vertices.root(t.x);
    if (!seen[root]) ++report.components;
    seen[root] = true;
  }
}

void count_coincident(const TriangleMesh& mesh, ShellReport& report) {
  std::vector<std::array<float, 3>> positions;
  positions.reserve(mesh.positions.size());
  std::vector<bool> used(mesh.positions.size(), false);
  for (const glm::uvec3& t : mesh.triangles) used[t.x] = used[t.y] = used[t.z] = true;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::vec3& p = mesh.positions[v];
    if (used[v]) positions.push_back({p.x, p.y, p.z});
  }
  std::sort(positions.begin(), positions.end());
  const auto distinct = std::unique(positions.begin(), positions.end());
  report.coincident_vertices = static_cast<std::size_t>(positions.end() - distinct);
}

void measure(const TriangleMesh& mesh, ShellReport& report) {
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]);
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
    if (normal == glm::dvec3(0.0)) ++report.degenerate;
    report.area_mm2 += 0.5 * glm::length(normal);
    report.volume_mm3 += glm::dot(a, normal) / 6.0;
  }
}

}  // namespace

ShellReport check_shell(const TriangleMesh& mesh) {
  ShellReport report;
  report.triangles = mesh.triangles.size();
  DisjointSets corners(3 * mesh.triangles.size());
  const std::size_t edges = check_edges(mesh, report, corners);
  check_vertices(mesh, report, corners);
  count_components(mesh, report);
  count_coincident(mesh, report);
  measure(mesh, report);
  report.euler = static_cast<std::int64_t>(report.vertices) - static_cast<std::int64_t>(edges) +
                 static_cast<std::int64_t>(report.triangles);
  return report;
}

}  // namespace nacre

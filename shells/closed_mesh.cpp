#include "shells/closed_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "core/error.h"

namespace nacre {
namespace {

constexpr std::size_t kMaxTriangles = 0xFFFFFFFE / 3;
constexpr std::size_t kLeastValence = 3;

[[noreturn]] void reject_edge(std::uint32_t from, std::uint32_t to) {
  throw Error(ErrorCode::BadArgument,
              fmt::format("surface: found edge {}-{} without exactly one triangle to each side, "
                          "expected a closed, oriented, manifold surface",
                          from, to));
}

}  // namespace

ClosedMesh::ClosedMesh(std::span<const glm::uvec3> triangles, std::size_t vertex_count)
    : outgoing_(vertex_count, kNone), source_(vertex_count) {
  if (triangles.size() > kMaxTriangles) {
    throw Error(ErrorCode::Unsupported, fmt::format("surface: found {} triangles, expected at most "
                                                    "{}",
                                                    triangles.size(), kMaxTriangles));
  }
  std::iota(source_.begin(), source_.end(), 0u);
  vertex_.reserve(3 * triangles.size());
  for (const glm::uvec3& t : triangles) vertex_.insert(vertex_.end(), {t.x, t.y, t.z});
  match_half_edges(vertex_count);
  split_fans();
}

/// Sorts half-edges into buckets by their lesser vertex, where each finds its opposite.
void ClosedMesh::match_half_edges(std::size_t vertex_count) {
  const std::size_t count = vertex_.size();
  opposite_.assign(count, kNone);
  std::vector<std::uint32_t> end(vertex_count + 1, 0);
  const auto lesser = [&](std::uint32_t h) { return std::min(from(h), to(h)); };
  for (std::uint32_t h = 0; h < count; ++h) ++end[lesser(h) + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<std::uint32_t> bucketed(count);
  // Afterwards end[v] is the end of v's bucket, and the start of the next.
  for (std::uint32_t h = 0; h < count; ++h) bucketed[end[lesser(h)]++] = h;
  std::size_t begin = 0;
  for (std::size_t v = 0; v < vertex_count; begin = end[v], ++v) {
    for (std::size_t i = begin; i < end[v]; ++i) {
      const std::uint32_t h = bucketed[i];
      if (from(h) == to(h)) reject_edge(from(h), to(h));
      for (std::size_t j = begin; j < i; ++j) {
        const std::uint32_t other = bucketed[j];
        if (from(other) == from(h) && to(other) == to(h)) reject_edge(from(h), to(h));
        if (from(other) == to(h) && to(other) == from(h)) link(h, other);
      }
    }
  }
  const auto unmatched = std::find(opposite_.begin(), opposite_.end(), kNone);
  if (unmatched != opposite_.end()) {
    const auto h = static_cast<std::uint32_t>(unmatched - opposite_.begin());
    reject_edge(from(h), to(h));
  }
}

/// Gives every fan of triangles its own vertex: the first keeps the number, others get new ones.
void ClosedMesh::split_fans() {
  std::vector<bool> visited(vertex_.size(), false);
  for (std::uint32_t h = 0; h < vertex_.size(); ++h) {
    if (visited[h]) continue;
    const std::uint32_t vertex = vertex_[h];
    std::uint32_t fan = vertex;
    if (outgoing_[vertex] != kNone) {
      fan = static_cast<std::uint32_t>(outgoing_.size());
      outgoing_.push_back(kNone);
      source_.push_back(vertex);
    }
    outgoing_[fan] = h;
    for_each_outgoing(fan, [&](std::uint32_t spoke) {
      visited[spoke] = true;
      vertex_[spoke] = fan;
    });
  }
}

std::size_t ClosedMesh::valence(std::uint32_t vertex) const {
  std::size_t count = 0;
  for_each_outgoing(vertex, [&](std::uint32_t) { ++count; });
  return count;
}

bool ClosedMesh::are_neighbours(std::uint32_t a, std::uint32_t b) const {
  const std::uint32_t first = outgoing_[a];
  if (first == kNone) return false;
  std::uint32_t h = first;
  do {
    if (to(h) == b) return true;
    h = next(opposite_[h]);
  } while (h != first);
  return false;
}

/// Whether a vertex has as few neighbours as it can.
bool ClosedMesh::is_least(std::uint32_t vertex) const {
  const std::uint32_t first = outgoing_[vertex];
  std::uint32_t h = first;
  for (std::size_t i = 0; i < kLeastValence; ++i) h = next(opposite_[h]);
  return h == first;
}

bool ClosedMesh::can_collapse(std::uint32_t h) const {
  const std::uint32_t u = from(h);
  const std::uint32_t v = to(h);
  if (is_least(apex(h)) || is_least(apex(opposite(h)))) return false;
  std::size_t shared = 0;
  for_each_outgoing(u, [&](std::uint32_t spoke) {
    if (to(spoke) != v && are_neighbours(to(spoke), v)) ++shared;
  });
  return shared == 2;
}

void ClosedMesh::collapse(std::uint32_t h) {
  const std::uint32_t o = opposite(h);
  const std::uint32_t u = from(h);
  const std::uint32_t v = to(h);
  const std::uint32_t a = apex(h);
  const std::uint32_t b = apex(o);
  for_each_outgoing(u, [&](std::uint32_t spoke) { vertex_[spoke] = v; });
  // What met the two triangles meets itself across the edges v a and v b.
  const std::uint32_t to_a = opposite(previous(h));
  const std::uint32_t from_a = opposite(next(h));
  const std::uint32_t to_b = opposite(previous(o));
  const std::uint32_t from_b = opposite(next(o));
  link(to_a, from_a);
  link(to_b, from_b);
  outgoing_[u] = kNone;
  outgoing_[v] = to_a;
  outgoing_[a] = from_a;
  outgoing_[b] = from_b;
  kill_triangle(h / 3);
  kill_triangle(o / 3);
}

bool ClosedMesh::can_flip(std::uint32_t h) const {
  const std::uint32_t a = apex(h);
  const std::uint32_t b = apex(opposite(h));
  return a != b && valence(from(h)) > kLeastValence && valence(to(h)) > kLeastValence &&
         !are_neighbours(a, b);
}

void ClosedMesh::flip(std::uint32_t h) {
  const std::uint32_t o = opposite(h);
  const std::uint32_t u = from(h);
  const std::uint32_t v = to(h);
  const std::uint32_t a = apex(h);
  const std::uint32_t b = apex(o);
  const std::uint32_t beyond_va = opposite(next(h));
  const std::uint32_t beyond_au = opposite(previous(h));
  const std::uint32_t beyond_ub = opposite(next(o));
  const std::uint32_t beyond_bv = opposite(previous(o));
  const std::uint32_t s = h / 3 * 3;  // becomes a b v
  const std::uint32_t t = o / 3 * 3;  // becomes b a u
  vertex_[s] = a;
  vertex_[s + 1] = b;
  vertex_[s + 2] = v;
  vertex_[t] = b;
  vertex_[t + 1] = a;
  vertex_[t + 2] = u;
  link(s, t);
  link(s + 1, beyond_bv);
  link(s + 2, beyond_va);
  link(t + 1, beyond_au);
  link(t + 2, beyond_ub);
  outgoing_[a] = s;
  outgoing_[b] = t;
  outgoing_[v] = s + 2;
  outgoing_[u] = t + 2;
}

void ClosedMesh::kill_vertex(std::uint32_t vertex) {
  // Neighbours may be gone already, but opposites still tell the way round.
  for_each_outgoing(vertex, [&](std::uint32_t h) { kill_triangle(h / 3); });
  outgoing_[vertex] = kNone;
}

void ClosedMesh::kill_triangle(std::size_t triangle) {
  for (std::size_t i = 0; i < 3; ++i) vertex_[3 * triangle + i] = kNone;
}

std::vector<glm::dvec3> positions_of(const ClosedMesh& mesh, const TriangleMesh& surface) {
  std::vector<glm::dvec3> positions(mesh.vertex_count());
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    positions[v] = glm::dvec3(surface.positions[mesh.source(v)]);
  }
  return positions;
}

TriangleMesh live_surface(const ClosedMesh& mesh, std::span<const glm::dvec3> positions) {
  TriangleMesh surface;
  std::vector<std::uint32_t> number(positions.size());
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    if (mesh.outgoing(v) == ClosedMesh::kNone) continue;
    number[v] = static_cast<std::uint32_t>(surface.positions.size());
    surface.positions.emplace_back(positions[v]);
  }
  std::size_t alive = 0;
  for (std::size_t face = 0; face < mesh.triangle_count(); ++face) alive += mesh.is_alive(face);
  surface.triangles.reserve(alive);
  for (std::size_t face = 0; face < mesh.triangle_count(); ++face) {
    if (!mesh.is_alive(face)) continue;
    const glm::uvec3 t = mesh.triangle(face);
    surface.triangles.emplace_back(number[t.x], number[t.y], number[t.z]);
  }
  return surface;
}

}  // namespace nacre

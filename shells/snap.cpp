#include "shells/snap.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/quantization_grid.h"
#include "shells/closed_mesh.h"
#include "shells/disjoint_sets.h"
#include "shells/grid_points.h"

namespace nacre {
namespace {

__extension__ using Wide = __int128;  // six times a volume in grid units has up to 72 bits

constexpr int kNearReach = 1;
constexpr int kFarReach = 6;

[[noreturn]] void reject_grid(const QuantizationGrid& grid) {
  throw Error(ErrorCode::BadArgument,
              fmt::format("quantisation: found a grid of {} bits and a step of {} mm, expected one "
                          "fine enough to hold the surface",
                          grid.bits, step_mm(grid)));
}

/// The passes of snapping one surface; each leaves a closed manifold.
class Snapper {
 public:
  Snapper(const TriangleMesh& surface, const QuantizationGrid& grid, const BorderRounding* border);

  void find_components();
  void collapse_coincident_edges();
  void separate_coincident_vertices();
  void resolve_degenerate_triangles();
  void drop_vanished_components();
  SnappedSurface take() const;

 private:
  using Corners = std::array<GridIndex, 3>;

  glm::vec3 original(std::uint32_t v) const { return surface_.positions[mesh_.source(v)]; }
  glm::dvec3 target(std::uint32_t v) const {
    return (glm::dvec3(original(v)) - grid_.origin_mm) / step_mm(grid_);
  }
  bool is_alive(std::uint32_t v) const { return mesh_.outgoing(v) != ClosedMesh::kNone; }
  bool is_flat(const glm::uvec3& t) const {
    return twice_area(points_[t.x], points_[t.y], points_[t.z]) == glm::i64vec3(0);
  }

  bool merge_with_neighbour(std::uint32_t v);
  bool move_to_free_point(std::uint32_t v, int reach);
  bool has_flat_triangle(std::uint32_t v) const;
  bool resolve(std::size_t triangle);
  bool flip_away(std::uint32_t h);
  bool collapse_away(std::uint32_t h);
  bool nudge(std::uint32_t v, int reach);

  const TriangleMesh& surface_;
  const QuantizationGrid& grid_;
  ClosedMesh mesh_;
  std::vector<GridIndex> points_;         ///< of each vertex of `mesh_`
  std::vector<std::uint32_t> component_;  ///< of each vertex: the component's least vertex
  std::vector<int> sense_;                ///< of each component: the sign of its volume
  OccupiedPoints occupied_;
  SnapReport report_;
};

Snapper::Snapper(const TriangleMesh& surface, const QuantizationGrid& grid,
                 const BorderRounding* border)
    : surface_(surface),
      grid_(grid),
      mesh_(surface.triangles, surface.positions.size()),
      points_(mesh_.vertex_count()),
      occupied_(grid.bits) {
  for (std::uint32_t v = 0; v < points_.size(); ++v) {
    points_[v] = border != nullptr ? border->index(original(v)) : nearest_index(grid_, original(v));
  }
}

/// Makes the ends of an edge one vertex where they share a grid point, unless that would pinch the
/// surface. A collapse may free the way for others, so it goes on until nothing changes.
void Snapper::collapse_coincident_edges() {
  std::vector<std::uint32_t> edges;
  for (std::uint32_t h = 0; h < mesh_.half_edge_count(); ++h) {
    if (mesh_.is_alive(h / 3) && h < mesh_.opposite(h) &&
        points_[mesh_.from(h)] == points_[mesh_.to(h)])
      edges.push_back(h);
  }
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<std::uint32_t> left;
    for (const std::uint32_t h : edges) {
      if (!mesh_.is_alive(h / 3)) continue;
      if (!mesh_.can_collapse(h)) {
        left.push_back(h);
        continue;
      }
      mesh_.collapse(h);
      ++report_.collapsed_edges;
      changed = true;
    }
    edges = std::move(left);
  }
}

/// Gives every vertex a grid point of its own, the first comer the nearest one. Where triangles are
/// smaller than a step the others go to a neighbour; where sheets touch they make way.
void Snapper::separate_coincident_vertices() {
  occupied_.reserve(mesh_.vertex_count() - report_.collapsed_edges);
  std::vector<std::uint32_t> homeless;
  for (std::uint32_t v = 0; v < points_.size(); ++v) {
    if (is_alive(v) && !occupied_.take(points_[v])) homeless.push_back(v);
  }
  std::erase_if(homeless, [&](std::uint32_t v) { return merge_with_neighbour(v); });
  for (const std::uint32_t v : homeless) {
    if (!move_to_free_point(v, kNearReach) && !move_to_free_point(v, kFarReach)) reject_grid(grid_);
    ++report_.moved_vertices;
  }
}

/// Merges a vertex that has no point of its own with its nearest neighbour, if one is a step away.
bool Snapper::merge_with_neighbour(std::uint32_t v) {
  constexpr std::int64_t kDiagonalStep = 3;
  std::vector<std::pair<std::int64_t, std::uint32_t>> edges;
  mesh_.for_each_outgoing(v, [&](std::uint32_t h) {
    const std::int64_t distance = squared_distance(points_[v], points_[mesh_.to(h)]);
    if (distance <= kDiagonalStep) edges.emplace_back(distance, h);
  });
  std::sort(edges.begin(), edges.end());
  for (const auto& [distance, h] : edges) {
    if (!mesh_.can_collapse(h)) continue;
    mesh_.collapse(h);
    ++report_.collapsed_edges;
    return true;
  }
  return false;
}

bool Snapper::move_to_free_point(std::uint32_t v, int reach) {
  for (const GridIndex& point : occupied_.around(points_[v], reach, target(v))) {
    if (!occupied_.take(point)) continue;
    points_[v] = point;
    return true;
  }
  return false;
}

/// Every step taken leaves fewer triangles without area, so this ends.
void Snapper::resolve_degenerate_triangles() {
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
    if (mesh_.is_alive(t) && is_flat(mesh_.triangle(t)) && !resolve(t)) reject_grid(grid_);
  }
}

bool Snapper::has_flat_triangle(std::uint32_t v) const {
  bool found = false;
  mesh_.for_each_outgoing(
      v, [&](std::uint32_t h) { found = found || is_flat(mesh_.triangle(h / 3)); });
  return found;
}

/// A triangle whose corners lie on a line: its longest side passes through the third corner, and is
/// best flipped, which changes no shape. Else its shortest side is collapsed, or a corner moved.
bool Snapper::resolve(std::size_t triangle) {
  std::array<std::uint32_t, 3> sides{};
  for (std::uint32_t i = 0; i < 3; ++i) sides[i] = static_cast<std::uint32_t>(3 * triangle) + i;
  std::sort(sides.begin(), sides.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto length = [&](std::uint32_t h) {
      return squared_distance(points_[mesh_.from(h)], points_[mesh_.to(h)]);
    };
    return length(a) > length(b);
  });
  if (flip_away(sides[0])) return true;
  if (collapse_away(sides[2]) || collapse_away(mesh_.opposite(sides[2]))) return true;
  for (const int reach : {kNearReach, kFarReach}) {
    for (const std::uint32_t side : sides) {
      if (nudge(mesh_.apex(side), reach)) return true;
    }
  }
  return false;
}

bool Snapper::flip_away(std::uint32_t h) {
  if (!mesh_.can_flip(h)) return false;
  const std::uint32_t a = mesh_.apex(h);
  const std::uint32_t b = mesh_.apex(mesh_.opposite(h));
  if (is_flat({a, b, mesh_.to(h)}) || is_flat({b, a, mesh_.from(h)})) return false;
  mesh_.flip(h);
  ++report_.flipped_edges;
  return true;
}

/// Collapses an edge unless a triangle that stays would have no area.
bool Snapper::collapse_away(std::uint32_t h) {
  if (!mesh_.can_collapse(h)) return false;
  const std::uint32_t u = mesh_.from(h);
  const std::uint32_t v = mesh_.to(h);
  bool clean = true;
  mesh_.for_each_outgoing(u, [&](std::uint32_t spoke) {
    if (mesh_.to(spoke) == v || mesh_.apex(spoke) == v) return;
    clean = clean && !is_flat({v, mesh_.to(spoke), mesh_.apex(spoke)});
  });
  if (!clean) return false;
  mesh_.collapse(h);
  occupied_.release(points_[u]);
  ++report_.collapsed_edges;
  return true;
}

/// Moves a vertex to a free point from which all its triangles have an area.
bool Snapper::nudge(std::uint32_t v, int reach) {
  const GridIndex before = points_[v];
  for (const GridIndex& point : occupied_.around(before, reach, target(v))) {
    if (!occupied_.is_free(point)) continue;
    points_[v] = point;
    if (has_flat_triangle(v)) continue;
    occupied_.release(before);
    occupied_.take(point);
    ++report_.moved_vertices;
    return true;
  }
  points_[v] = before;
  return false;
}

int sign(double x) { return (x > 0.0) - (x < 0.0); }
int sign(Wide x) { return (x > 0) - (x < 0); }

/// Labels components by a vertex of theirs, and notes which way round each is.
void Snapper::find_components() {
  DisjointSets sets(mesh_.vertex_count());
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
    sets.join(mesh_.triangle(t).x, mesh_.triangle(t).y);
    sets.join(mesh_.triangle(t).y, mesh_.triangle(t).z);
  }
  component_.resize(mesh_.vertex_count());
  for (std::uint32_t v = 0; v < component_.size(); ++v) component_[v] = sets.root(v);
  std::vector<double> volume(mesh_.vertex_count(), 0.0);
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
    const glm::uvec3 c = mesh_.triangle(t);
    const std::uint32_t label = component_[c.x];
    // Relative to a vertex of the component: what is small stays exact.
    const glm::dvec3 a = target(c.x);
    volume[label] += glm::dot(a - target(label), glm::cross(target(c.y) - a, target(c.z) - a));
  }
  sense_.resize(mesh_.vertex_count());
  std::transform(volume.begin(), volume.end(), sense_.begin(), [](double v) { return sign(v); });
}

/// Drops components whose volume on the grid, exact, is zero or has changed its sign.
void Snapper::drop_vanished_components() {
  std::vector<Wide> volume(mesh_.vertex_count(), 0);
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
    if (!mesh_.is_alive(t)) continue;
    const glm::uvec3 c = mesh_.triangle(t);
    const glm::i64vec3 normal = twice_area(points_[c.x], points_[c.y], points_[c.z]);
    const glm::i64vec3 offset(points_[c.x]);
    Wide& sum = volume[component_[c.x]];
    for (int axis = 0; axis < 3; ++axis) sum += Wide{offset[axis]} * normal[axis];
  }
  std::vector<bool> vanished(mesh_.vertex_count(), false);
  for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
    const std::uint32_t label = component_[v];
    if (!is_alive(v) || (volume[label] != 0 && sign(volume[label]) == sense_[label])) continue;
    if (!vanished[label]) ++report_.dropped_components;
    vanished[label] = true;
    mesh_.kill_vertex(v);
  }
}

SnappedSurface Snapper::take() const {
  SnappedSurface result;
  result.report = report_;
  std::size_t triangles = 0;
  std::vector<std::uint32_t> number(mesh_.vertex_count(), ClosedMesh::kNone);
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
    if (!mesh_.is_alive(t)) continue;
    const glm::uvec3 corners = mesh_.triangle(t);
    for (int i = 0; i < 3; ++i) number[corners[i]] = 0;
    ++triangles;
  }
  // Exactly as large as needed: all shells may stand in memory side by side.
  result.mesh.positions.reserve(
      number.size() -
      static_cast<std::size_t>(std::count(number.begin(), number.end(), ClosedMesh::kNone)));
  result.mesh.triangles.reserve(triangles);
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == ClosedMesh::kNone) continue;
    number[v] = static_cast<std::uint32_t>(result.mesh.positions.size());
    result.mesh.positions.push_back(grid_position(grid_, points_[v]));
  }
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
    if (!mesh_.is_alive(t)) continue;
    const glm::uvec3 c = mesh_.triangle(t);
    result.mesh.triangles.emplace_back(number[c.x], number[c.y], number[c.z]);
  }
  return result;
}

}  // namespace

SnapReport& SnapReport::operator+=(const SnapReport& other) {
  collapsed_edges += other.collapsed_edges;
  moved_vertices += other.moved_vertices;
  flipped_edges += other.flipped_edges;
  dropped_components += other.dropped_components;
  return *this;
}

SnappedSurface snap(const TriangleMesh& surface, const QuantizationGrid& grid,
                    const BorderRounding* border) {
  if (!is_exact(grid)) {
    throw Error(ErrorCode::BadArgument,
                "quantisation: found a grid whose points are not floats, "
                "expected an exact one");
  }
  Snapper snapper(surface, grid, border);
  snapper.find_components();
  // What vanishes on rounding goes at once, what turns over on making way, at the end.
  snapper.drop_vanished_components();
  snapper.collapse_coincident_edges();
  snapper.separate_coincident_vertices();
  snapper.resolve_degenerate_triangles();
  snapper.drop_vanished_components();
  return snapper.take();
}

}  // namespace nacre

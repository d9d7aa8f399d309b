#include "shells/crossings.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <unordered_map>

#include "core/quantization_grid.h"
#include "shells/field_bounds.h"

namespace nacre {
namespace {

__extension__ using Wide = __int128;  // products of three differences of 23 bits

using GridTriangle = std::array<glm::ivec3, 3>;

/// Sign of the volume of a tetrahedron of grid points.
int orientation(const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& c,
                const glm::ivec3& d) {
  const glm::i64vec3 u(b - a);
  const glm::i64vec3 v(c - a);
  const glm::i64vec3 w(d - a);
  const Wide volume = static_cast<Wide>(u.y * v.z - u.z * v.y) * w.x +
                      static_cast<Wide>(u.z * v.x - u.x * v.z) * w.y +
                      static_cast<Wide>(u.x * v.y - u.y * v.x) * w.z;
  return volume > 0 ? 1 : volume < 0 ? -1 : 0;
}

using Sides = std::array<int, 3>;

/// On which sides of triangle `t` the corners of `s` lie.
Sides sides(const GridTriangle& t, const GridTriangle& s) {
  return {orientation(t[0], t[1], t[2], s[0]), orientation(t[0], t[1], t[2], s[1]),
          orientation(t[0], t[1], t[2], s[2])};
}

bool is_on_both_sides(const Sides& sides) {
  return std::max({sides[0], sides[1], sides[2]}) > 0 &&
         std::min({sides[0], sides[1], sides[2]}) < 0;
}

/// Whether the line through p and q meets the closed triangle.
bool line_meets(const glm::ivec3& p, const glm::ivec3& q, const GridTriangle& t) {
  const Sides around{orientation(p, q, t[0], t[1]), orientation(p, q, t[1], t[2]),
                     orientation(p, q, t[2], t[0])};
  return !is_on_both_sides(around);
}

/// Whether a side of `s` meets `t`. @param s_sides  of `t`'s plane
bool side_meets(const GridTriangle& s, const Sides& s_sides, const GridTriangle& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (s_sides[i] * s_sides[j] > 0 || (s_sides[i] == 0 && s_sides[j] == 0)) continue;
    if (line_meets(s[i], s[j], t)) return true;
  }
  return false;
}

/// Whether two triangles cross: they meet, each with corners on both sides of the other. (The
/// segment in which the planes' common line meets both then ends at a side of one of them.)
bool cross(const GridTriangle& s, const GridTriangle& t) {
  const Sides of_t = sides(s, t);
  if (!is_on_both_sides(of_t)) return false;
  const Sides of_s = sides(t, s);
  return is_on_both_sides(of_s) && (side_meets(s, of_s, t) || side_meets(t, of_t, s));
}

/// A surface in grid coordinates.
class GridSurface {
 public:
  GridSurface(const TriangleMesh& mesh, const QuantizationGrid& grid) : mesh_(mesh) {
    points_.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions) points_.push_back(nearest_index(grid, p));
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(mesh_.triangles.size()); }
  GridTriangle triangle(std::uint32_t t) const {
    const glm::uvec3& corners = mesh_.triangles[t];
    return {points_[corners.x], points_[corners.y], points_[corners.z]};
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<glm::ivec3> points_;
};

struct Box {
  glm::ivec3 lo;
  glm::ivec3 hi;
};

Box box_of(const GridTriangle& t) {
  return {glm::min(glm::min(t[0], t[1]), t[2]), glm::max(glm::max(t[0], t[1]), t[2])};
}

bool overlap(const Box& a, const Box& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y &&
         a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
}

/// Some triangles of a surface by the cells of a coarse lattice that their boxes reach.
class CellTable {
 public:
  CellTable(const GridSurface& surface, const std::vector<std::uint32_t>& chosen)
      : surface_(surface) {
    for (const std::uint32_t t : chosen) {
      const Box box = box_of(surface.triangle(t));
      for_each_cell(box, [&](std::uint64_t cell) { cells_[cell].push_back(t); });
    }
  }

  /// Calls `visit` once with every triangle whose box meets that one.
  template <class Visit>
  void near(const Box& box, Visit&& visit) const {
    for_each_cell(box, [&](std::uint64_t cell) {
      const auto found = cells_.find(cell);
      if (found == cells_.end()) return;
      for (const std::uint32_t t : found->second) {
        const Box other = box_of(surface_.triangle(t));
        // Pairs are met in every cell they share: in the lowest only they count.
        if (overlap(box, other) && key(glm::max(box.lo, other.lo)) == cell) visit(t);
      }
    });
  }

 private:
  static constexpr int kCellBits = 6;  // 64 steps: a spacing or less

  static std::uint64_t key(const glm::ivec3& p) {
    const auto part = [](int index) { return static_cast<std::uint64_t>(index >> kCellBits); };
    return part(p.x) | part(p.y) << 20U | part(p.z) << 40U;
  }

  template <class Visit>
  static void for_each_cell(const Box& box, Visit&& visit) {
    constexpr int kCell = 1 << kCellBits;
    const glm::ivec3 lo = box.lo / kCell;
    const glm::ivec3 hi = box.hi / kCell;
    for (int z = lo.z; z <= hi.z; ++z) {
      for (int y = lo.y; y <= hi.y; ++y) {
        for (int x = lo.x; x <= hi.x; ++x) visit(key(glm::ivec3(x, y, z) * kCell));
      }
    }
  }

  const GridSurface& surface_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// Pairs of a chosen triangle of `a` and any of `b`, those of `b` left out that are `excluded`
/// (ascending).
std::size_t count_pairs(const GridSurface& a, const std::vector<std::uint32_t>& chosen,
                        const GridSurface& b, const std::vector<std::uint32_t>& excluded) {
  if (chosen.empty()) return 0;
  const CellTable table(a, chosen);
  std::size_t pairs = 0;
  auto next_excluded = excluded.begin();
  for (std::uint32_t t = 0; t < b.size(); ++t) {
    if (next_excluded != excluded.end() && *next_excluded == t) {
      ++next_excluded;
      continue;
    }
    const GridTriangle triangle = b.triangle(t);
    table.near(box_of(triangle), [&](std::uint32_t s) {
      if (cross(a.triangle(s), triangle)) ++pairs;
    });
  }
  return pairs;
}

std::vector<NeighbourCrossings> neighbours(const ShellSet& set,
                                           const std::vector<StrayTriangles>& strays) {
  std::vector<NeighbourCrossings> list;
  std::size_t outer = set.shells.size();
  for (std::size_t k = 0; k < set.shells.size(); ++k) {
    if (set.shells[k].surface.triangles.empty()) continue;
    if (outer < k) list.push_back({outer, k, strays[outer].hi < strays[k].lo, 0});
    outer = k;
  }
  return list;
}

}  // namespace

StrayTriangles find_stray_triangles(const TriangleMesh& surface, const TrilinearField& field,
                                    const EmissionMap& emission, double below, double above,
                                    double step_mm) {
  StrayTriangles strays;
  const double border = border_voxels(field, step_mm);
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const glm::uvec3& corners = surface.triangles[t];
    const glm::dvec3 a(surface.positions[corners.x]);
    const glm::dvec3 b(surface.positions[corners.y]);
    const glm::dvec3 c(surface.positions[corners.z]);
    if (is_cap(field, a, b, c, border)) continue;
    const ValueBounds values = value_bounds(field, field.voxel_from_local(a),
                                            field.voxel_from_local(b), field.voxel_from_local(c));
    const double lo = emission(values.lo);
    const double hi = emission(values.hi);
    strays.lo = std::min(strays.lo, lo);
    strays.hi = std::max(strays.hi, hi);
    if (hi >= above) strays.inwards.push_back(t);
    if (lo <= below) strays.outwards.push_back(t);
  }
  return strays;
}

std::vector<NeighbourCrossings> count_crossings(const ShellSet& set,
                                                const std::vector<StrayTriangles>& strays) {
  std::vector<NeighbourCrossings> list = neighbours(set, strays);
  tbb::parallel_for(std::size_t{0}, list.size(), [&](std::size_t i) {
    NeighbourCrossings& pair = list[i];
    if (pair.impossible) return;
    const GridSurface outer(set.shells[pair.outer].surface, *set.grid);
    const GridSurface inner(set.shells[pair.inner].surface, *set.grid);
    const std::vector<std::uint32_t>& inwards = strays[pair.outer].inwards;
    pair.pairs = count_pairs(outer, inwards, inner, {}) +
                 count_pairs(inner, strays[pair.inner].outwards, outer, inwards);
  });
  return list;
}

}  // namespace nacre

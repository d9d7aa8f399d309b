#include "shells/crossings.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "core/quantization_grid.h"
#include "shells/border_planes.h"

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

constexpr int kCellBits = 6;  // cells of 64 steps: a smallest spacing or less

/// Calls `visit(cell)` with every cell that a box reaches.
template <class Visit>
void for_each_cell(const Box& box, Visit&& visit) {
  for (int z = box.lo.z >> kCellBits; z <= box.hi.z >> kCellBits; ++z) {
    for (int y = box.lo.y >> kCellBits; y <= box.hi.y >> kCellBits; ++y) {
      for (int x = box.lo.x >> kCellBits; x <= box.hi.x >> kCellBits; ++x)
        visit(glm::ivec3(x, y, z));
    }
  }
}

std::size_t hash_of(const glm::ivec3& cell) {
  const auto part = [](int index) { return static_cast<std::uint64_t>(index); };
  const std::uint64_t key = part(cell.x) | part(cell.y) << 20U | part(cell.z) << 40U;
  return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 24U);
}

}  // namespace

/// A surface in grid coordinates, its triangles by the cells they reach. Cells share slots of a
/// table where their hashes do.
class CrossingCounter::Surface {
 public:
  Surface(const TriangleMesh& mesh, const ShellSet& set) {
    const BorderPlanes border(set);
    std::vector<glm::ivec3> points;
    points.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions) points.push_back(nearest_index(*set.grid, p));
    triangles_.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) {
      if (border.hold_triangle(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z])) {
        continue;
      }
      triangles_.push_back({points[t.x], points[t.y], points[t.z]});
    }
    fill_table();
  }

  const std::vector<GridTriangle>& triangles() const { return triangles_; }

  /// How many triangles cross that one.
  std::size_t crossings(const GridTriangle& triangle) const {
    const Box box = box_of(triangle);
    std::size_t count = 0;
    for_each_cell(box, [&](const glm::ivec3& cell) {
      const std::size_t slot = hash_of(cell) & mask_;
      for (std::size_t i = begin_[slot]; i < end_[slot]; ++i) {
        const GridTriangle& other = triangles_[entries_[i]];
        const Box other_box = box_of(other);
        // Pairs meet in every cell they share: in the lowest only they count.
        const glm::ivec3 lowest = glm::max(box.lo, other_box.lo);
        const glm::ivec3 lowest_cell(lowest.x >> kCellBits, lowest.y >> kCellBits,
                                     lowest.z >> kCellBits);
        if (overlap(box, other_box) && lowest_cell == cell && cross(other, triangle)) ++count;
      }
    });
    return count;
  }

 private:
  /// Counts, then places.
  void fill_table() {
    mask_ = std::bit_ceil(2 * triangles_.size() + 1) - 1;
    begin_.assign(mask_ + 2, 0);
    for (const GridTriangle& t : triangles_) {
      for_each_cell(box_of(t),
                    [&](const glm::ivec3& cell) { ++begin_[(hash_of(cell) & mask_) + 1]; });
    }
    for (std::size_t slot = 1; slot < begin_.size(); ++slot) begin_[slot] += begin_[slot - 1];
    entries_.resize(begin_.back());
    end_.assign(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for_each_cell(box_of(triangles_[t]), [&](const glm::ivec3& cell) {
        const std::size_t slot = hash_of(cell) & mask_;
        const std::uint32_t end = end_[slot];
        // Once a slot, also where several of its cells share that.
        if (end == begin_[slot] || entries_[end - 1] != t) entries_[end_[slot]++] = t;
      });
    }
  }

  std::vector<GridTriangle> triangles_;  ///< caps left out
  std::size_t mask_ = 0;
  std::vector<std::uint32_t> begin_;  ///< of each slot in `entries_`
  std::vector<std::uint32_t> end_;
  std::vector<std::uint32_t> entries_;
};

CrossingCounter::CrossingCounter(const ShellSet& set) : set_(set) {}
CrossingCounter::~CrossingCounter() = default;

void CrossingCounter::add(std::size_t shell, const TriangleMesh& surface) {
  auto inner = std::make_unique<const Surface>(surface, set_);
  if (outer_) {
    const std::vector<GridTriangle>& triangles = inner->triangles();
    const std::size_t pairs = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, triangles.size(), 1024), std::size_t{0},
        [&](const auto& range, std::size_t count) {
          for (std::size_t t = range.begin(); t < range.end(); ++t) {
            count += outer_->crossings(triangles[t]);
          }
          return count;
        },
        std::plus<>());
    result_.push_back({outer_shell_, shell, pairs});
  }
  outer_ = std::move(inner);
  outer_shell_ = shell;
}

}  // namespace nacre

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

/// Blocks of 2^bits steps along each axis.
class Cells {
 public:
  explicit Cells(const glm::ivec3& bits) : bits_(bits) {}

  glm::ivec3 at(const glm::ivec3& p) const {
    return {p.x >> bits_.x, p.y >> bits_.y, p.z >> bits_.z};
  }

  /// Calls `visit(cell)` with every cell that a box reaches.
  template <class Visit>
  void for_each(const Box& box, Visit&& visit) const {
    const glm::ivec3 lo = at(box.lo);
    const glm::ivec3 hi = at(box.hi);
    for (int z = lo.z; z <= hi.z; ++z) {
      for (int y = lo.y; y <= hi.y; ++y) {
        for (int x = lo.x; x <= hi.x; ++x) visit(glm::ivec3(x, y, z));
      }
    }
  }

  int bits(int axis) const { return bits_[axis]; }

 private:
  glm::ivec3 bits_;
};

/// Cells about as large as most triangles, so that those reach few.
Cells cells_for(const std::vector<GridTriangle>& triangles) {
  glm::dvec3 sum(0.0);
  for (const GridTriangle& t : triangles) {
    const Box box = box_of(t);
    sum += glm::dvec3(box.hi - box.lo);
  }
  const glm::uvec3 mean(sum / static_cast<double>(std::max<std::size_t>(triangles.size(), 1)));
  return Cells({std::bit_width(mean.x), std::bit_width(mean.y), std::bit_width(mean.z)});
}

/// All of whose bits depend on all coordinates (the finaliser of SplitMix64).
std::uint64_t hash_of(const glm::ivec3& cell) {
  const auto part = [](int index) { return static_cast<std::uint64_t>(index); };
  std::uint64_t key = part(cell.x) | part(cell.y) << 20U | part(cell.z) << 40U;
  key = (key ^ key >> 30U) * 0xBF58476D1CE4E5B9ULL;
  key = (key ^ key >> 27U) * 0x94D049BB133111EBULL;
  return key ^ key >> 31U;
}

/// The part of a triangle's box in one cell, rounded outwards to what fits a byte: small enough to
/// look through many.
struct CellBox {
  std::array<std::uint8_t, 3> lo;  ///< from the cell's corner
  std::array<std::uint8_t, 3> hi;
  std::uint16_t tag;  ///< of the cell: tells it from most that share its slot

  bool operator==(const CellBox&) const = default;
};

CellBox clipped(const Box& box, const glm::ivec3& cell, const Cells& cells) {
  CellBox part{};
  for (int axis = 0; axis < 3; ++axis) {
    const int last = (1 << cells.bits(axis)) - 1;
    const int shift = std::max(cells.bits(axis) - 8, 0);
    const int corner = cell[axis] << cells.bits(axis);
    const auto i = static_cast<std::size_t>(axis);
    part.lo[i] = static_cast<std::uint8_t>(std::max(box.lo[axis] - corner, 0) >> shift);
    part.hi[i] = static_cast<std::uint8_t>(std::min(box.hi[axis] - corner, last) >> shift);
  }
  part.tag = static_cast<std::uint16_t>(hash_of(cell));
  return part;
}

bool overlap(const CellBox& a, const CellBox& b) {
  return a.tag == b.tag && a.lo[0] <= b.hi[0] && b.lo[0] <= a.hi[0] && a.lo[1] <= b.hi[1] &&
         b.lo[1] <= a.hi[1] && a.lo[2] <= b.hi[2] && b.lo[2] <= a.hi[2];
}

}  // namespace

/// A surface in grid coordinates, its triangles by the cells they reach. Cells share slots of a
/// table where their hashes do.
class CrossingCounter::Surface {
 public:
  Surface(const TriangleMesh& mesh, const ShellSet& set) {
    std::vector<glm::ivec3> points;
    points.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions) points.push_back(nearest_index(*set.grid, p));
    const std::vector<glm::uvec3> triangles = BorderPlanes(set).triangles_off(mesh);
    triangles_.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) {
      triangles_.push_back({points[t.x], points[t.y], points[t.z]});
    }
    cells_ = cells_for(triangles_);
    fill_table();
  }

  const std::vector<GridTriangle>& triangles() const { return triangles_; }

  /// How many triangles cross that one.
  std::size_t crossings(const GridTriangle& triangle) const {
    const Box box = box_of(triangle);
    std::size_t count = 0;
    cells_.for_each(box, [&](const glm::ivec3& cell) {
      const CellBox part = clipped(box, cell, cells_);
      const std::size_t slot = slot_of(cell);
      for (std::size_t i = begin_[slot]; i < begin_[slot + 1]; ++i) {
        if (!overlap(part, entries_[i].box)) continue;
        const GridTriangle& other = triangles_[entries_[i].triangle];
        const Box other_box = box_of(other);
        // Pairs meet in every cell that their boxes share: in the lowest only they count.
        const bool counts = overlap(box, other_box) &&
                            cells_.at(glm::max(box.lo, other_box.lo)) == cell &&
                            clipped(other_box, cell, cells_) == entries_[i].box;
        if (counts && cross(other, triangle)) ++count;
      }
    });
    return count;
  }

 private:
  struct Entry {
    CellBox box;
    std::uint32_t triangle;
  };

  std::size_t slot_of(const glm::ivec3& cell) const {
    return static_cast<std::size_t>(hash_of(cell) >> 32U) & mask_;
  }

  /// Counts, then places.
  void fill_table() {
    mask_ = std::bit_ceil(2 * triangles_.size() + 1) - 1;
    begin_.assign(mask_ + 2, 0);
    for (const GridTriangle& t : triangles_) {
      cells_.for_each(box_of(t), [&](const glm::ivec3& cell) { ++begin_[slot_of(cell) + 1]; });
    }
    for (std::size_t slot = 1; slot < begin_.size(); ++slot) begin_[slot] += begin_[slot - 1];
    entries_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const Box box = box_of(triangles_[t]);
      cells_.for_each(box, [&](const glm::ivec3& cell) {
        entries_[next[slot_of(cell)]++] = {clipped(box, cell, cells_), t};
      });
    }
  }

  std::vector<GridTriangle> triangles_;  ///< caps left out
  Cells cells_{glm::ivec3(0)};
  std::size_t mask_ = 0;
  std::vector<std::uint32_t> begin_;  ///< of each slot in `entries_`
  std::vector<Entry> entries_;
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

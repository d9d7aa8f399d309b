#include "shells/crossings.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>

#include "core/quantization_grid.h"
#include "shells/border_planes.h"
#include "shells/triangle_crossing.h"

namespace nacre {
namespace {

struct Box {
  glm::ivec3 lo{std::numeric_limits<int>::max()};
  glm::ivec3 hi{std::numeric_limits<int>::lowest()};
};

bool overlap(const Box& a, const Box& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y &&
         a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
}

/// Bricks of 2^bits steps along each axis that cover a box.
class Bricks {
 public:
  /// @param most  larger bricks are taken where those of `bits` would be more
  Bricks(const Box& box, const glm::ivec3& bits, std::size_t most) : bits_(bits) {
    while (true) {
      first_ = brick_of(box.lo);
      counts_ = brick_of(box.hi) - first_ + 1;
      if (size() <= std::max<std::size_t>(most, 1)) return;
      bits_ += 1;
    }
  }

  std::size_t size() const {
    const glm::u64vec3 counts(counts_);
    return counts.x * counts.y * counts.z;
  }

  /// The number of the brick of a point in the box.
  std::uint32_t at(const glm::ivec3& point) const { return number(brick_of(point)); }

  /// Calls `visit(number)` with every brick that a box reaches.
  template <class Visit>
  void for_each(const Box& box, Visit&& visit) const {
    const glm::ivec3 lo = glm::max(brick_of(box.lo), first_);
    const glm::ivec3 hi = glm::min(brick_of(box.hi), first_ + counts_ - 1);
    for (int z = lo.z; z <= hi.z; ++z) {
      for (int y = lo.y; y <= hi.y; ++y) {
        for (int x = lo.x; x <= hi.x; ++x) visit(number({x, y, z}));
      }
    }
  }

 private:
  glm::ivec3 brick_of(const glm::ivec3& p) const {
    return {p.x >> bits_.x, p.y >> bits_.y, p.z >> bits_.z};
  }

  std::uint32_t number(const glm::ivec3& brick) const {
    const glm::ivec3 at = brick - first_;
    return static_cast<std::uint32_t>((at.z * counts_.y + at.y) * counts_.x + at.x);
  }

  glm::ivec3 bits_;
  glm::ivec3 first_{0};
  glm::ivec3 counts_{1};
};

/// A triangle of a brick.
struct Item {
  Box box;
  std::uint32_t triangle;
};

}  // namespace

/// A surface in grid coordinates, without its caps.
class GridSurface {
 public:
  GridSurface(const TriangleMesh& mesh, const ShellSet& set)
      : triangles_(BorderPlanes(set).triangles_off(mesh)) {
    points_.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions) {
      points_.push_back(nearest_index(*set.grid, p));
      box_ = {glm::min(box_.lo, points_.back()), glm::max(box_.hi, points_.back())};
    }
  }

  const Box& box() const { return box_; }
  std::size_t size() const { return triangles_.size(); }

  GridTriangle triangle(std::size_t t) const {
    const glm::uvec3& corners = triangles_[t];
    return {points_[corners.x], points_[corners.y], points_[corners.z]};
  }

  Box box_of(std::size_t t) const {
    const GridTriangle corners = triangle(t);
    return {glm::min(glm::min(corners[0], corners[1]), corners[2]),
            glm::max(glm::max(corners[0], corners[1]), corners[2])};
  }

  /// Bits of bricks that are some three times as large as most triangles' boxes: few of those reach
  /// two, and few share one.
  glm::ivec3 brick_bits() const {
    glm::dvec3 sum(0.0);
    for (std::size_t t = 0; t < size(); ++t) {
      const Box box = box_of(t);
      sum += glm::dvec3(box.hi - box.lo);
    }
    const glm::uvec3 mean(sum / static_cast<double>(std::max<std::size_t>(size(), 1)));
    return glm::ivec3(std::bit_width(mean.x), std::bit_width(mean.y), std::bit_width(mean.z)) + 1;
  }

 private:
  std::vector<glm::ivec3> points_;
  std::vector<glm::uvec3> triangles_;
  Box box_;
};

namespace {

/// The triangles of a surface by the bricks they reach.
class BrickLists {
 public:
  BrickLists(const GridSurface& surface, const Bricks& bricks) : surface_(surface) {
    begin_.assign(bricks.size() + 1, 0);
    for (std::size_t t = 0; t < surface.size(); ++t) {
      bricks.for_each(surface.box_of(t), [&](std::uint32_t brick) { ++begin_[brick]; });
    }
    std::uint32_t end = 0;
    for (std::uint32_t& begin : begin_) begin = end += begin;
    triangles_.resize(end);
    // Filled from each list's end, which leaves its beginning in `begin_`.
    for (std::size_t t = surface.size(); t-- > 0;) {
      bricks.for_each(surface.box_of(t), [&](std::uint32_t brick) {
        triangles_[--begin_[brick]] = static_cast<std::uint32_t>(t);
      });
    }
  }

  bool is_empty(std::size_t brick) const { return begin_[brick] == begin_[brick + 1]; }

  /// Those of a brick, by the lower x of their boxes.
  void items(std::size_t brick, std::vector<Item>& items) const {
    items.clear();
    for (std::uint32_t i = begin_[brick]; i < begin_[brick + 1]; ++i) {
      items.push_back({surface_.box_of(triangles_[i]), triangles_[i]});
    }
    std::sort(items.begin(), items.end(),
              [](const Item& a, const Item& b) { return a.box.lo.x < b.box.lo.x; });
  }

 private:
  const GridSurface& surface_;
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> triangles_;
};

/// Calls `visit(a, b)` with every two whose boxes overlap along x, in two ascending lists.
template <class Visit>
void for_each_pair_along_x(std::span<const Item> a, std::span<const Item> b, Visit&& visit) {
  while (!a.empty() && !b.empty()) {
    if (a.front().box.lo.x <= b.front().box.lo.x) {
      for (const Item& other : b) {
        if (other.box.lo.x > a.front().box.hi.x) break;
        visit(a.front(), other);
      }
      a = a.subspan(1);
    } else {
      for (const Item& other : a) {
        if (other.box.lo.x > b.front().box.hi.x) break;
        visit(other, b.front());
      }
      b = b.subspan(1);
    }
  }
}

struct Lists {
  std::vector<Item> outer;
  std::vector<Item> inner;
};

std::size_t count_crossings(const GridSurface& outer, const GridSurface& inner) {
  // Only where both are can they cross.
  const Box common{glm::max(outer.box().lo, inner.box().lo),
                   glm::min(outer.box().hi, inner.box().hi)};
  if (!overlap(outer.box(), inner.box())) return 0;
  const Bricks bricks(common, glm::max(outer.brick_bits(), inner.brick_bits()),
                      outer.size() + inner.size());
  std::optional<BrickLists> of_outer;
  std::optional<BrickLists> of_inner;
  tbb::parallel_invoke([&] { of_outer.emplace(outer, bricks); },
                       [&] { of_inner.emplace(inner, bricks); });
  tbb::enumerable_thread_specific<Lists> scratch;
  const auto in_brick = [&](std::size_t brick) {
    if (of_outer->is_empty(brick) || of_inner->is_empty(brick)) return std::size_t{0};
    Lists& lists = scratch.local();
    of_outer->items(brick, lists.outer);
    of_inner->items(brick, lists.inner);
    std::size_t count = 0;
    for_each_pair_along_x(lists.outer, lists.inner, [&](const Item& a, const Item& b) {
      // Pairs meet in every brick that their boxes share: in the lowest only they count.
      if (!overlap(a.box, b.box) || bricks.at(glm::max(a.box.lo, b.box.lo)) != brick) return;
      if (cross(outer.triangle(a.triangle), inner.triangle(b.triangle))) ++count;
    });
    return count;
  };
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, bricks.size(), 64), std::size_t{0},
      [&](const auto& range, std::size_t count) {
        for (std::size_t brick = range.begin(); brick < range.end(); ++brick) {
          count += in_brick(brick);
        }
        return count;
      },
      std::plus<>());
}

}  // namespace

CrossingCounter::CrossingCounter(const ShellSet& set) : set_(set) {}
CrossingCounter::~CrossingCounter() = default;

void CrossingCounter::add(std::size_t shell, const TriangleMesh& surface) {
  auto inner = std::make_unique<const GridSurface>(surface, set_);
  if (outer_) result_.push_back({outer_shell_, shell, count_crossings(*outer_, *inner)});
  outer_ = std::move(inner);
  outer_shell_ = shell;
}

}  // namespace nacre

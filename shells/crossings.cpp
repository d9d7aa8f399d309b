#include "shells/crossings.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "core/quantization_grid.h"
#include "shells/border_planes.h"
#include "shells/crossing_candidates.h"
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

  /// Of a brick's sides.
  const glm::ivec3& bits() const { return bits_; }

  /// The lowest point of a brick.
  glm::ivec3 lowest(std::size_t number) const {
    const auto at = static_cast<int>(number);
    const int row = at / counts_.x;
    const glm::ivec3 brick = first_ + glm::ivec3(at % counts_.x, row % counts_.y, row / counts_.y);
    return {brick.x << bits_.x, brick.y << bits_.y, brick.z << bits_.z};
  }

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

  /// Those of a brick.
  void triangles(std::size_t brick, std::vector<GridTriangle>& triangles) const {
    triangles.clear();
    for (std::uint32_t i = begin_[brick]; i < begin_[brick + 1]; ++i) {
      triangles.push_back(surface_.triangle(triangles_[i]));
    }
  }

 private:
  const GridSurface& surface_;
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> triangles_;
};

/// What counting in a brick needs.
struct Scratch {
  std::vector<GridTriangle> outer;
  std::vector<GridTriangle> inner;
  CrossingCandidates candidates;
  std::vector<std::uint32_t> found;
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
  if (!of_outer || !of_inner) return 0;  // cancelled: making another surface failed
  tbb::enumerable_thread_specific<Scratch> scratch;
  const auto in_brick = [&](std::size_t brick) {
    if (of_outer->is_empty(brick) || of_inner->is_empty(brick)) return std::size_t{0};
    Scratch& in = scratch.local();
    of_outer->triangles(brick, in.outer);
    of_inner->triangles(brick, in.inner);
    in.candidates.assign(in.inner, bricks.lowest(brick), bricks.bits());
    std::size_t count = 0;
    for (const GridTriangle& triangle : in.outer) {
      // Pairs meet in every brick that their boxes share: in the lowest only they count.
      in.candidates.find(triangle, in.found);
      for (const std::uint32_t other : in.found) {
        if (cross(triangle, in.inner[other])) ++count;
      }
    }
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

std::vector<NeighbourCrossings> count_neighbour_crossings(const ShellSet& set,
                                                          std::span<const std::size_t> shells,
                                                          const SurfaceOfShell& surface_of,
                                                          std::size_t at_once,
                                                          const ProgressCallback& progress) {
  ProgressMeter meter(progress, "nesting", shells.size());
  std::vector<NeighbourCrossings> result;
  // Only numbers go through the pipeline, which does not free what it holds when a stage throws.
  std::vector<std::unique_ptr<const GridSurface>> surfaces(shells.size());
  std::size_t next = 0;
  const auto number = [&](tbb::flow_control& control) {
    if (next == shells.size()) control.stop();
    return next++;
  };
  const auto make = [&](std::size_t i) {
    surfaces[i] = std::make_unique<const GridSurface>(surface_of(shells[i]), set);
    return i;
  };
  const auto count = [&](std::size_t i) {
    if (i > 0) {
      // Isolated: a thread that waits for the others must not take up another surface meanwhile.
      const std::size_t pairs = tbb::this_task_arena::isolate(
          [&] { return count_crossings(*surfaces[i - 1], *surfaces[i]); });
      result.push_back({shells[i - 1], shells[i], pairs});
      surfaces[i - 1].reset();
    }
    meter.advance();
  };
  using tbb::filter_mode;
  tbb::parallel_pipeline(
      std::max<std::size_t>(at_once, 1),
      tbb::make_filter<void, std::size_t>(filter_mode::serial_in_order, number) &
          tbb::make_filter<std::size_t, std::size_t>(filter_mode::parallel, make) &
          tbb::make_filter<std::size_t, void>(filter_mode::serial_in_order, count));
  return result;
}

}  // namespace nacre

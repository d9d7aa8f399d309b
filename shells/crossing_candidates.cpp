#include "shells/crossing_candidates.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace nacre {
namespace {

using Floats = TriangleGroup::Floats;
using Points = TriangleGroup::Points;
constexpr std::size_t kLanes = TriangleGroup::kLanes;
using Mask [[gnu::vector_size(4 * kLanes)]] = std::int32_t;

/// Where no triangle is.
constexpr float kNowhere = 1 << 24;

constexpr std::size_t kWordBits = 64;

Floats least(const Floats& u, const Floats& v) { return u < v ? u : v; }
Floats greatest(const Floats& u, const Floats& v) { return u > v ? u : v; }
Floats least(const Floats& u, const Floats& v, const Floats& w) { return least(least(u, v), w); }
Floats greatest(const Floats& u, const Floats& v, const Floats& w) {
  return greatest(greatest(u, v), w);
}

Points difference(const Points& p, const Points& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }

Points everywhere(const glm::vec3& p) { return {Floats{} + p.x, Floats{} + p.y, Floats{} + p.z}; }

/// Works out the rest from the corners.
inline void prepare(TriangleGroup& t) {
  const Points& a = t.a;
  const Points& b = t.b;
  const Points& c = t.c;
  t.lo = {least(a.x, b.x, c.x), least(a.y, b.y, c.y), least(a.z, b.z, c.z)};
  t.hi = {greatest(a.x, b.x, c.x), greatest(a.y, b.y, c.y), greatest(a.z, b.z, c.z)};
  const Points sides = difference(t.hi, t.lo);
  t.size = greatest(sides.x, sides.y, sides.z);
  const Points u = difference(b, a);
  const Points v = difference(c, a);
  t.normal = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

/// Of pairs whose boxes meet and of which `s` begins at `lowest` or above.
inline Mask boxes_meet(const TriangleGroup& t, const TriangleGroup& s, const Points& lowest) {
  return (s.lo.x <= t.hi.x) & (s.hi.x >= t.lo.x) & (s.lo.x >= lowest.x) &  //
         (s.lo.y <= t.hi.y) & (s.hi.y >= t.lo.y) & (s.lo.y >= lowest.y) &  //
         (s.lo.z <= t.hi.z) & (s.hi.z >= t.lo.z) & (s.lo.z >= lowest.z);
}

/// A point's distance from a triangle's plane, times the normal's length.
inline Floats side(const TriangleGroup& t, const Points& p) {
  return (p.x - t.a.x) * t.normal.x + (p.y - t.a.y) * t.normal.y + (p.z - t.a.z) * t.normal.z;
}

/// What rounding may add to a `side` or take from it, at most, for pairs whose boxes meet.
///
/// With S the size of the triangle with the plane and R that of both together, S bounds the parts
/// of two sides, R those of p - a, all integers below 2^24. A normal's part is at most 2 S^2, and
/// rounding moves it by 4 S^2 units of 2^-24; the sum is at most 6 S^2 R, and is moved by 3 * 4
/// S^2 R such units through the normal and 3 * 6 S^2 R by its own three roundings: by 30 S^2 R and
/// a little, less than 32 S^2 R. While 6 S^2 R is below 2^24 nothing is rounded.
inline Floats rounding(const Floats& size, const Floats& both) {
  const Floats bound = 0x1p-19F * (size * size * both);
  return bound > 4.0F ? bound : Floats{};
}

[[gnu::always_inline]] inline Mask may_be_on_both_sides(const TriangleGroup& t,
                                                        const TriangleGroup& s,
                                                        const Floats& both) {
  const Floats a = side(t, s.a);
  const Floats b = side(t, s.b);
  const Floats c = side(t, s.c);
  const Floats doubt = rounding(t.size, both);
  return (least(a, b, c) < doubt) & (greatest(a, b, c) > -doubt);
}

/// A bit a lane.
unsigned bits_of(const Mask& mask) {
#ifdef __SSE2__
  return static_cast<unsigned>(__builtin_ia32_movmskps(std::bit_cast<Floats>(mask)));
#else
  unsigned bits = 0;
  for (std::size_t i = 0; i < kLanes; ++i) bits |= mask[i] != 0 ? 1U << i : 0U;
  return bits;
#endif
}

/// A bit a pair that may cross and of which `s` begins at `lowest` or above.
inline unsigned may_cross(const TriangleGroup& t, const TriangleGroup& s, const Points& lowest) {
  Mask mask = boxes_meet(t, s, lowest);
  if (bits_of(mask) == 0) return 0;
  const Floats both = s.size + t.size;
  mask &= may_be_on_both_sides(t, s, both);
  if (bits_of(mask) == 0) return 0;
  mask &= may_be_on_both_sides(s, t, both);
  return bits_of(mask);
}

}  // namespace

CrossingCandidates::SlabBits CrossingCandidates::slab_bits(
    const std::vector<GridTriangle>& triangles, std::size_t first) const {
  SlabBits bits;
  const std::size_t end = std::min(first + kWordBits, triangles.size());
  for (std::size_t i = first; i < end; ++i) {
    const auto& [a, b, c] = triangles[i];
    const glm::ivec3 lo = slab_of(glm::min(glm::min(a, b), c));
    const glm::ivec3 hi = slab_of(glm::max(glm::max(a, b), c));
    const std::uint64_t bit = std::uint64_t{1} << (i - first);
    for (int axis = 0; axis < 3; ++axis) {
      bits.begun[axis][lo[axis]] |= bit;
      bits.ahead[axis][hi[axis]] |= bit;
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (int slab = 1; slab < kSlabs; ++slab) {
      bits.begun[axis][slab] |= bits.begun[axis][slab - 1];
      bits.ahead[axis][kSlabs - 1 - slab] |= bits.ahead[axis][kSlabs - slab];
    }
  }
  return bits;
}

void CrossingCandidates::assign(const std::vector<GridTriangle>& triangles,
                                const glm::ivec3& lowest, const glm::ivec3& bits) {
  lowest_ = lowest;
  slab_shift_ = glm::max(bits - std::countr_zero(unsigned{kSlabs}), 0);
  slab_bits_.clear();
  for (std::size_t first = 0; first < triangles.size(); first += kWordBits) {
    slab_bits_.push_back(slab_bits(triangles, first));
  }
  groups_.resize((triangles.size() + kLanes - 1) / kLanes);
  for (std::size_t i = 0; i < groups_.size() * kLanes; ++i) {
    TriangleGroup& group = groups_[i / kLanes];
    const std::size_t lane = i % kLanes;
    const auto set = [&](auto& point, const glm::vec3& to) {
      point.x[lane] = to.x;
      point.y[lane] = to.y;
      point.z[lane] = to.z;
    };
    const bool is_there = i < triangles.size();
    set(group.a, is_there ? glm::vec3(triangles[i][0]) : glm::vec3(kNowhere));
    set(group.b, is_there ? glm::vec3(triangles[i][1]) : glm::vec3(kNowhere));
    set(group.c, is_there ? glm::vec3(triangles[i][2]) : glm::vec3(kNowhere));
  }
  for (TriangleGroup& group : groups_) prepare(group);
}

void CrossingCandidates::find(const GridTriangle& triangle,
                              std::vector<std::uint32_t>& found) const {
  found.clear();
  const auto& [a, b, c] = triangle;
  const glm::ivec3 lo = glm::min(glm::min(a, b), c);
  const glm::ivec3 hi = glm::max(glm::max(a, b), c);
  const glm::ivec3 first_slab = slab_of(lo);
  const glm::ivec3 last_slab = slab_of(hi);
  TriangleGroup t;
  t.a = everywhere(a);
  t.b = everywhere(b);
  t.c = everywhere(c);
  prepare(t);
  // Where the triangle itself begins in the brick, the other one may begin anywhere.
  const Points from =
      everywhere(glm::mix(lowest_, glm::ivec3(0), glm::greaterThanEqual(lo, lowest_)));
  for (std::size_t w = 0; w < slab_bits_.size(); ++w) {
    const auto& [begun, ahead] = slab_bits_[w];
    std::uint64_t bits = begun[0][last_slab.x] & ahead[0][first_slab.x] &  //
                         begun[1][last_slab.y] & ahead[1][first_slab.y] &  //
                         begun[2][last_slab.z] & ahead[2][first_slab.z];
    while (bits != 0) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(bits)) / kLanes * kLanes;
      bits &= ~(((std::uint64_t{1} << kLanes) - 1) << bit);
      const std::size_t first = w * kWordBits + bit;
      for (unsigned lanes = may_cross(t, groups_[first / kLanes], from); lanes != 0;
           lanes &= lanes - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
        found.push_back(static_cast<std::uint32_t>(first + lane));
      }
    }
  }
}

}  // namespace nacre

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "shells/triangle_crossing.h"

namespace nacre {

/// Four triangles side by side in GCC's vector types, which any processor has, with what telling
/// most pairs apart takes. All but the normal is exact.
struct TriangleGroup {
  static constexpr std::size_t kLanes = 4;
  using Floats [[gnu::vector_size(4 * kLanes)]] = float;
  struct Points {
    Floats x{}, y{}, z{};
  };

  Points a, b, c;
  Points lo, hi;  ///< of the boxes
  Points normal;  ///< (b - a) x (c - a)
  Floats size{};  ///< the boxes' longest sides
};

/// Triangles of a brick, among which those are found that another one may cross.
///
/// Passes over pairs whose boxes are apart, and over those of which float arithmetic shows that one
/// has not corners on both sides of the other. Where it rounds, what rounding may decide is found.
class CrossingCandidates {
 public:
  /// @param triangles  corners from 0 to 2^23 - 1
  /// @param lowest  the brick's lowest point
  /// @param bits  its sides are 2^bits
  void assign(const std::vector<GridTriangle>& triangles, const glm::ivec3& lowest,
              const glm::ivec3& bits);

  /// Numbers of triangles, ascending: all that `triangle` crosses are among them, but for those
  /// with which its box shares points below the brick along an axis.
  void find(const GridTriangle& triangle, std::vector<std::uint32_t>& found) const;

 private:
  /// The brick is cut into so many slabs along each axis; triangles beyond count to the last ones.
  static constexpr int kSlabs = 16;

  /// Of up to 64 triangles, a bit each.
  struct SlabBits {
    using PerSlab = std::array<std::array<std::uint64_t, kSlabs>, 3>;
    PerSlab begun{};  ///< that begin in a slab or before
    PerSlab ahead{};  ///< that end in a slab or after
  };

  int slab_of(int coordinate, int axis) const {
    const int slab = (coordinate - lowest_[axis]) >> slab_shift_[axis];
    return std::clamp(slab, 0, kSlabs - 1);
  }

  glm::ivec3 slab_of(const glm::ivec3& p) const {
    return {slab_of(p.x, 0), slab_of(p.y, 1), slab_of(p.z, 2)};
  }

  SlabBits slab_bits(const std::vector<GridTriangle>& triangles, std::size_t first) const;

  std::vector<TriangleGroup> groups_;
  std::vector<SlabBits> slab_bits_;
  glm::ivec3 lowest_{0};
  glm::ivec3 slab_shift_{0};
};

}  // namespace nacre

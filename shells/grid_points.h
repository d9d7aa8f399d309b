#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace nacre {

using GridIndex = glm::ivec3;

/// Twice the area vector of a triangle of grid points, exact: indices have at most 23 bits.
glm::i64vec3 twice_area(const GridIndex& a, const GridIndex& b, const GridIndex& c) noexcept;

/// Squared distance of two grid points, exact.
std::int64_t squared_distance(const GridIndex& a, const GridIndex& b) noexcept;

/// Whether a grid of that many bits has the point.
bool is_in_grid(const GridIndex& point, int bits) noexcept;

/// Which grid points vertices lie on, and the free ones near a position.
///
/// A hash table with linear probing: its entries are the points themselves, a quarter of what nodes
/// would need.
class OccupiedPoints {
 public:
  /// @param bits  of the grid
  explicit OccupiedPoints(int bits) : bits_(bits) {}

  /// Makes room for `count` points.
  void reserve(std::size_t count);

  /// Takes a point; false if it is taken.
  bool take(const GridIndex& point);
  void release(const GridIndex& point);
  bool is_free(const GridIndex& point) const;

  /// The points of the grid at most `reach` steps away along each axis, nearest to `target` (in
  /// grid coordinates) first, equally near ones in a fixed order.
  std::vector<GridIndex> around(const GridIndex& point, int reach, const glm::dvec3& target) const;

 private:
  std::size_t slot_of(const GridIndex& point) const;

  int bits_;
  std::vector<GridIndex> slots_;  ///< a power of two of them
  std::size_t used_ = 0;          ///< released ones too
};

}  // namespace nacre

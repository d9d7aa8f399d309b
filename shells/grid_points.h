#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

namespace nacre {

using GridIndex = glm::ivec3;

/// Twice the area vector of a triangle of grid points, exact: indices have at most 23 bits.
glm::i64vec3 twice_area(const GridIndex& a, const GridIndex& b, const GridIndex& c) noexcept;

/// Squared distance of two grid points, exact.
std::int64_t squared_distance(const GridIndex& a, const GridIndex& b) noexcept;

/// Which grid points vertices lie on, and the free ones near a position.
class OccupiedPoints {
 public:
  /// @param bits  of the grid
  explicit OccupiedPoints(int bits) : side_(std::int32_t{1} << bits) {}

  void reserve(std::size_t count) { owner_.reserve(count); }

  /// Takes a point for a vertex; false if another has it.
  bool take(const GridIndex& point, std::uint32_t vertex) {
    return owner_.try_emplace(key(point), vertex).second;
  }
  void release(const GridIndex& point) { owner_.erase(key(point)); }
  bool is_free(const GridIndex& point) const { return !owner_.contains(key(point)); }

  /// The points of the grid at most `reach` steps away along each axis, nearest to `target` (in
  /// grid coordinates) first, equally near ones in a fixed order.
  std::vector<GridIndex> around(const GridIndex& point, int reach, const glm::dvec3& target) const;

 private:
  struct Key {
    std::int64_t xy;
    std::int32_t z;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const noexcept;
  };
  static Key key(const GridIndex& p) { return {static_cast<std::int64_t>(p.x) << 32 | p.y, p.z}; }

  std::int32_t side_;
  std::unordered_map<Key, std::uint32_t, Hash> owner_;
};

}  // namespace nacre

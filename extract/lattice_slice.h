#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "extract/sample_classes.h"

namespace nacre {

/// Bytes read past the end of a row of classes by loops that take several at a time.
inline constexpr std::size_t kRowPadding = 80;

/// Vertex numbers, level by level, of whatever crosses several levels at once.
///
/// The levels that cross one lattice edge are consecutive, so one number finds them all: level k's
/// vertex is `ids[handle + k]`, where the handle has the lowest level already subtracted (modulo
/// 2^32).
class VertexIds {
 public:
  void clear() { size_ = 0; }

  /// Room for the levels lo to hi - 1; sets the handle.
  std::uint32_t* add(std::size_t lo, std::size_t hi, std::uint32_t& handle) {
    if (size_ + (hi - lo) > ids_.size()) ids_.resize(2 * ids_.size() + (hi - lo) + 1024);
    handle = static_cast<std::uint32_t>(size_ - lo);
    std::uint32_t* added = ids_.data() + size_;
    size_ += hi - lo;
    return added;
  }

  std::size_t size() const { return size_; }
  const std::uint32_t* data() const { return ids_.data(); }

 private:
  std::vector<std::uint32_t> ids_;
  std::size_t size_ = 0;
};

/// Handles by sample of a slice; only those of crossed edges are ever written or read.
using HandleMap = std::unique_ptr<std::uint32_t[]>;

/// What the sweep keeps of one slice of samples: classes, and the vertices in its plane.
struct LatticeSlice {
  LatticeSlice(std::size_t nx, std::size_t ny)
      : classes(nx * ny + kRowPadding),
        bricks(brick_count(nx) * ny),
        x_edges(std::make_unique_for_overwrite<std::uint32_t[]>(nx * ny)),
        y_edges(std::make_unique_for_overwrite<std::uint32_t[]>(nx * ny)),
        corners(std::make_unique_for_overwrite<std::uint32_t[]>(nx * ny)) {}

  std::vector<std::uint8_t> classes;
  std::vector<ClassRange> bricks;  ///< row by row
  HandleMap x_edges;               ///< by their lower sample
  HandleMap y_edges;
  HandleMap corners;  ///< samples on the volume's border, where they are inside
  VertexIds ids;
};

/// The vertices between two slices.
struct LatticeGap {
  LatticeGap(std::size_t nx, std::size_t ny)
      : z_edges(std::make_unique_for_overwrite<std::uint32_t[]>(nx * ny)) {}

  HandleMap z_edges;
  VertexIds ids;
};

/// Calls `function(i)` for each i in [begin, end) with a[i] != b[i], eight at a time where they are
/// equal. Reads up to seven bytes past `end`.
template <class Function>
void for_each_difference(const std::uint8_t* a, const std::uint8_t* b, std::size_t begin,
                         std::size_t end, Function&& function) {
  static_assert(std::endian::native == std::endian::little, "the first byte is the lowest");
  for (std::size_t i = begin; i < end; i += 8) {
    std::uint64_t word_a = 0;
    std::uint64_t word_b = 0;
    std::memcpy(&word_a, a + i, 8);
    std::memcpy(&word_b, b + i, 8);
    std::uint64_t differences = word_a ^ word_b;
    while (differences != 0) {
      const auto byte = static_cast<std::size_t>(std::countr_zero(differences)) / 8;
      if (i + byte >= end) break;
      function(i + byte);
      differences &= ~(std::uint64_t{0xff} << (8 * byte));
    }
  }
}

}  // namespace nacre

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
/// 2^32). One such list serves a whole slab, a ninth of what the slab writes: its cells look up six
/// or more numbers a level, and all in one place.
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
};

/// The vertices between two slices.
struct LatticeGap {
  LatticeGap(std::size_t nx, std::size_t ny)
      : z_edges(std::make_unique_for_overwrite<std::uint32_t[]>(nx * ny)) {}

  HandleMap z_edges;
};

/// Bit i set where a[i] != b[i], of 64 each.
inline std::uint64_t difference_bits(const std::uint8_t* a, const std::uint8_t* b) {
  static_assert(std::endian::native == std::endian::little, "the first byte is the lowest");
  std::uint64_t bits = 0;
#ifdef __SSE2__
  using Bytes [[gnu::vector_size(16)]] = char;
  for (std::size_t i = 0; i < 64; i += 16) {
    Bytes lanes_a;
    Bytes lanes_b;
    std::memcpy(&lanes_a, a + i, 16);
    std::memcpy(&lanes_b, b + i, 16);
    const auto equal = static_cast<std::uint32_t>(__builtin_ia32_pmovmskb128(lanes_a == lanes_b));
    bits |= std::uint64_t{equal ^ 0xffffu} << i;
  }
#else
  constexpr std::uint64_t kLowBits = 0x7f7f7f7f7f7f7f7f;
  for (std::size_t i = 0; i < 64; i += 8) {
    std::uint64_t word_a = 0;
    std::uint64_t word_b = 0;
    std::memcpy(&word_a, a + i, 8);
    std::memcpy(&word_b, b + i, 8);
    const std::uint64_t differences = word_a ^ word_b;
    // A byte's top bit says whether any of its bits is set; the product collects the top bits.
    const std::uint64_t any = (((differences & kLowBits) + kLowBits) | differences) & ~kLowBits;
    bits |= ((any >> 7) * 0x0102040810204080 >> 56) << i;
  }
#endif
  return bits;
}

/// Calls `function(i)` for each i in [begin, end) with a[i] != b[i]. Reads up to 63 bytes past
/// `end`.
template <class Function>
void for_each_difference(const std::uint8_t* a, const std::uint8_t* b, std::size_t begin,
                         std::size_t end, Function&& function) {
  for (std::size_t i = begin; i < end; i += 64) {
    std::uint64_t bits = difference_bits(a + i, b + i);
    if (end - i < 64) bits &= (std::uint64_t{1} << (end - i)) - 1;
    for (; bits != 0; bits &= bits - 1) {
      function(i + static_cast<std::size_t>(std::countr_zero(bits)));
    }
  }
}

}  // namespace nacre

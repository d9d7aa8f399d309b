#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "extract/sample_range.h"
#include "extract/stored_levels.h"

namespace nacre {

/// Cells in a brick: a stretch of a row. Its samples are one more, shared with the next brick.
inline constexpr std::size_t kBrickCells = 64;

/// Number of bricks in a row of samples, at least two samples long.
constexpr std::size_t brick_count(std::size_t samples) {
  return (samples - 1 + kBrickCells - 1) / kBrickCells;
}

/// Lowest and highest class in a brick.
struct ClassRange {
  std::uint8_t lo = 0;
  std::uint8_t hi = 0;
};

/// Turns rows of stored samples into rows of classes (see `StoredLevels`).
///
/// A brick's range of samples comes first, a few instructions for sixteen samples; only where it
/// leaves the class of the brick's first sample is every sample looked at, and only against the
/// levels in that range.
template <class T>
class SampleClasses {
 public:
  explicit SampleClasses(const StoredLevels<T>& levels);

  /// The class of one sample.
  std::uint8_t of(T sample) const { return oriented(rank(sample)); }

  /// @param row      the samples, at least two
  /// @param classes  out: as many classes
  /// @param bricks   out: `brick_count(row.size())` ranges
  void of_row(std::span<const T> row, std::uint8_t* classes, ClassRange* bricks) const;

 private:
  static constexpr bool kHasTable = sizeof(T) <= 2;

  /// Number of thresholds not above the sample.
  std::uint8_t rank(T sample) const;
  std::uint8_t oriented(std::uint8_t q) const {
    return static_cast<std::uint8_t>(descending_ ? base_ - q : q);
  }
  void of_samples(std::span<const T> samples, std::uint8_t lo, std::uint8_t hi,
                  std::uint8_t* classes) const;
  ClassRange of_brick(std::span<const T> samples, std::uint8_t* classes) const;

  std::vector<T> thresholds_;
  std::vector<LaneRange<T>> spans_;  ///< the samples of each rank, in all lanes
  std::vector<std::uint8_t> table_;  ///< of the ranks, for types of 8 and 16 bits
  bool descending_;
  std::uint8_t base_;
};

}  // namespace nacre

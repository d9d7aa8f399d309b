#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>

namespace nacre {

/// A few samples side by side: GCC's and Clang's vectors, which become whatever the target has.
template <class T>
struct SampleLanes {
  static constexpr std::size_t kCount = 16 / sizeof(T);
  using Vector [[gnu::vector_size(16)]] = T;

  static Vector load(const T* samples) {
    Vector lanes;
    std::memcpy(&lanes, samples, sizeof lanes);
    return lanes;
  }
  static Vector min(Vector a, Vector b) { return a < b ? a : b; }
  static Vector max(Vector a, Vector b) { return a > b ? a : b; }

  /// Neighbours of `kWidth` lanes change places. As one wide lane each, or as halves of it: a
  /// shuffle of bytes takes the baseline of x86-64 some thirty instructions, these take one to
  /// three.
  template <std::size_t kWidth>
  static Vector swapped(Vector lanes) {
    constexpr std::size_t kBytes = kWidth * sizeof(T);
    if constexpr (kBytes == 8) {
      using Wide [[gnu::vector_size(16)]] = std::uint64_t;
      const Wide wide = std::bit_cast<Wide>(lanes);
      return std::bit_cast<Vector>(__builtin_shufflevector(wide, wide, 1, 0));
    } else if constexpr (kBytes == 4) {
      using Wide [[gnu::vector_size(16)]] = std::uint32_t;
      const Wide wide = std::bit_cast<Wide>(lanes);
      return std::bit_cast<Vector>(__builtin_shufflevector(wide, wide, 1, 0, 3, 2));
    } else {
      using Wide [[gnu::vector_size(16)]] =
          std::conditional_t<kBytes == 2, std::uint32_t, std::uint16_t>;
      const Wide wide = std::bit_cast<Wide>(lanes);
      return std::bit_cast<Vector>(wide << (8 * kBytes) | wide >> (8 * kBytes));
    }
  }

  template <std::size_t kWidth = kCount / 2>
  static T least(Vector lanes) {
    if constexpr (kWidth == 0) {
      return lanes[0];
    } else {
      return least<kWidth / 2>(min(lanes, swapped<kWidth>(lanes)));
    }
  }

  template <std::size_t kWidth = kCount / 2>
  static T largest(Vector lanes) {
    if constexpr (kWidth == 0) {
      return lanes[0];
    } else {
      return largest<kWidth / 2>(max(lanes, swapped<kWidth>(lanes)));
    }
  }
};

/// Smallest and largest samples lane by lane.
template <class T>
struct LaneRange {
  typename SampleLanes<T>::Vector least;
  typename SampleLanes<T>::Vector largest;
};

/// @param samples  at least as many as lanes, all finite
template <class T>
LaneRange<T> lane_range(std::span<const T> samples) {
  using Lanes = SampleLanes<T>;
  // The last lanes, which may overlap those before them.
  const auto last = Lanes::load(samples.data() + (samples.size() - Lanes::kCount));
  LaneRange<T> range{last, last};
  for (std::size_t i = 0; i + Lanes::kCount < samples.size(); i += Lanes::kCount) {
    const auto lanes = Lanes::load(samples.data() + i);
    range.least = Lanes::min(range.least, lanes);
    range.largest = Lanes::max(range.largest, lanes);
  }
  return range;
}

/// Smallest and largest sample.
/// @param samples  at least one, all finite
template <class T>
std::pair<T, T> sample_range(std::span<const T> samples) {
  using Lanes = SampleLanes<T>;
  if (samples.size() >= Lanes::kCount) {
    const LaneRange<T> range = lane_range(samples);
    return {Lanes::least(range.least), Lanes::largest(range.largest)};
  }
  const auto [least, largest] = std::ranges::minmax(samples);
  return {least, largest};
}

}  // namespace nacre

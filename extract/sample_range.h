#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
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

  /// The lanes in turn: lane i becomes lane i + kShift.
  template <std::size_t kShift, std::size_t... kLane>
  static Vector turned(Vector lanes, std::index_sequence<kLane...>) {
    return __builtin_shufflevector(lanes, lanes, ((kLane + kShift) % kCount)...);
  }

  template <std::size_t kWidth = kCount / 2>
  static T least(Vector lanes) {
    if constexpr (kWidth == 0) {
      return lanes[0];
    } else {
      constexpr auto kLanes = std::make_index_sequence<kCount>{};
      return least<kWidth / 2>(min(lanes, turned<kWidth>(lanes, kLanes)));
    }
  }

  template <std::size_t kWidth = kCount / 2>
  static T largest(Vector lanes) {
    if constexpr (kWidth == 0) {
      return lanes[0];
    } else {
      constexpr auto kLanes = std::make_index_sequence<kCount>{};
      return largest<kWidth / 2>(max(lanes, turned<kWidth>(lanes, kLanes)));
    }
  }
};

/// Smallest and largest sample.
/// @param samples  at least one, all finite
template <class T>
std::pair<T, T> sample_range(std::span<const T> samples) {
  using Lanes = SampleLanes<T>;
  T lo = samples.back();
  T hi = lo;
  std::size_t i = 0;
  if (samples.size() >= Lanes::kCount) {
    auto least = Lanes::load(samples.data());
    auto largest = least;
    for (; i + Lanes::kCount <= samples.size(); i += Lanes::kCount) {
      const auto lanes = Lanes::load(samples.data() + i);
      least = Lanes::min(least, lanes);
      largest = Lanes::max(largest, lanes);
    }
    lo = std::min(lo, Lanes::least(least));
    hi = std::max(hi, Lanes::largest(largest));
  }
  for (; i < samples.size(); ++i) {
    lo = std::min(lo, samples[i]);
    hi = std::max(hi, samples[i]);
  }
  return {lo, hi};
}

}  // namespace nacre

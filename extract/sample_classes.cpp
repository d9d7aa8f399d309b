#include "extract/sample_classes.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace nacre {
namespace {

/// Comparisons per sample up to which counting beats a binary search.
constexpr int kCountedLevels = 12;
/// And up to which it beats a table, where sixteen samples are compared at once.
constexpr int kCountedInBytes = 20;

template <class T>
std::size_t table_index(T sample) {
  return static_cast<std::size_t>(static_cast<std::int64_t>(sample) -
                                  static_cast<std::int64_t>(std::numeric_limits<T>::min()));
}

/// The sample before this one; the lowest has none and stays.
template <class T>
T before(T sample) {
  constexpr T kLowest = std::numeric_limits<T>::lowest();
  if (sample == kLowest) return sample;
  if constexpr (std::is_integral_v<T>) {
    return static_cast<T>(sample - 1);
  } else {
    return std::nextafter(sample, kLowest);
  }
}

/// Whether all lanes lie between those of `bounds`.
template <class T>
bool is_within(const LaneRange<T>& range, const LaneRange<T>& bounds) {
  const auto outside = (range.least < bounds.least) | (range.largest > bounds.largest);
  const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(outside);
  return (halves[0] | halves[1]) == 0;
}

/// The classes of a brick's first samples by comparing them, all in registers, with each level.
/// @param thresholds  those above lo
template <class T>
void count_thresholds(const T* samples, std::span<const T> thresholds, std::uint8_t lo,
                      std::uint8_t* classes) {
  using Lanes = SampleLanes<T>;
  using Bytes [[gnu::vector_size(16)]] = std::uint8_t;
  constexpr std::size_t kVectors = kBrickCells / Lanes::kCount;
  std::array<typename Lanes::Vector, kVectors> lanes;
  std::array<Bytes, kVectors> counts;
  for (std::size_t i = 0; i < kVectors; ++i) {
    lanes[i] = Lanes::load(samples + i * Lanes::kCount);
    counts[i] = Bytes{} + lo;
  }
  for (const T threshold : thresholds) {
    const auto bound = typename Lanes::Vector{} + threshold;
    for (std::size_t i = 0; i < kVectors; ++i) {
      counts[i] -= std::bit_cast<Bytes>(lanes[i] >= bound);  // true is -1
    }
  }
  std::memcpy(classes, counts.data(), kBrickCells);
}

}  // namespace

template <class T>
SampleClasses<T>::SampleClasses(const StoredLevels<T>& levels)
    : thresholds_(levels.thresholds),
      descending_(levels.descending),
      base_(static_cast<std::uint8_t>(levels.count)) {
  if constexpr (kHasTable) {
    std::vector<std::uint8_t> table(std::size_t{1} << (8 * sizeof(T)));
    for (const T threshold : thresholds_) ++table[table_index(threshold)];
    for (std::size_t i = 1; i < table.size(); ++i) {
      table[i] = static_cast<std::uint8_t>(table[i] + table[i - 1]);
    }
    table_ = std::move(table);
  }
  using Vector = typename SampleLanes<T>::Vector;
  for (std::size_t q = 0; q <= thresholds_.size(); ++q) {
    using Limits = std::numeric_limits<T>;
    const T least = q == 0 ? Limits::lowest() : thresholds_[q - 1];
    const T largest = q == thresholds_.size() ? Limits::max() : before(thresholds_[q]);
    spans_.push_back({Vector{} + least, Vector{} + largest});
  }
}

template <class T>
std::uint8_t SampleClasses<T>::rank(T sample) const {
  if constexpr (kHasTable) {
    return table_[table_index(sample)];
  } else {
    const auto above = std::upper_bound(thresholds_.begin(), thresholds_.end(), sample);
    return static_cast<std::uint8_t>(above - thresholds_.begin());
  }
}

template <class T>
void SampleClasses<T>::of_samples(std::span<const T> samples, std::uint8_t lo, std::uint8_t hi,
                                  std::uint8_t* classes) const {
  if constexpr (kHasTable) {
    std::size_t i = 0;
    if constexpr (sizeof(T) == 1) {
      if (hi - lo <= kCountedInBytes && samples.size() >= kBrickCells) {
        const auto thresholds = std::span(thresholds_).subspan(lo, hi - lo);
        count_thresholds<T>(samples.data(), thresholds, lo, classes);
        i = kBrickCells;
      }
    }
    for (; i < samples.size(); ++i) classes[i] = rank(samples[i]);
  } else if (hi - lo <= kCountedLevels) {
    std::memset(classes, lo, samples.size());
    for (std::size_t k = lo; k < hi; ++k) {
      const T threshold = thresholds_[k];
      for (std::size_t i = 0; i < samples.size(); ++i) {
        classes[i] = static_cast<std::uint8_t>(classes[i] + (samples[i] >= threshold ? 1 : 0));
      }
    }
  } else {
    for (std::size_t i = 0; i < samples.size(); ++i) classes[i] = rank(samples[i]);
  }
  if (!descending_) return;
  for (std::size_t i = 0; i < samples.size(); ++i) classes[i] = oriented(classes[i]);
}

template <class T>
ClassRange SampleClasses<T>::of_brick(std::span<const T> samples, std::uint8_t* classes) const {
  std::uint8_t lo = rank(samples.front());
  std::uint8_t hi = lo;
  if (samples.size() < SampleLanes<T>::kCount) {
    const auto [least, largest] = sample_range(samples);
    lo = rank(least);
    hi = rank(largest);
  } else if (const LaneRange<T> range = lane_range(samples); !is_within(range, spans_[lo])) {
    lo = rank(SampleLanes<T>::least(range.least));
    hi = rank(SampleLanes<T>::largest(range.largest));
  }
  if (lo == hi) {
    std::memset(classes, oriented(lo), samples.size());
  } else {
    of_samples(samples, lo, hi, classes);
  }
  return {std::min(oriented(lo), oriented(hi)), std::max(oriented(lo), oriented(hi))};
}

template <class T>
void SampleClasses<T>::of_row(std::span<const T> row, std::uint8_t* classes,
                              ClassRange* bricks) const {
  const std::size_t count = brick_count(row.size());
  for (std::size_t b = 0; b < count; ++b) {
    const std::size_t begin = b * kBrickCells;
    const auto samples = row.subspan(begin, std::min(kBrickCells + 1, row.size() - begin));
    bricks[b] = of_brick(samples, classes + begin);
  }
}

template class SampleClasses<std::uint8_t>;
template class SampleClasses<std::int8_t>;
template class SampleClasses<std::uint16_t>;
template class SampleClasses<std::int16_t>;
template class SampleClasses<std::uint32_t>;
template class SampleClasses<std::int32_t>;
template class SampleClasses<float>;
template class SampleClasses<double>;

}  // namespace nacre

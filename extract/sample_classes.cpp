#include "extract/sample_classes.h"

#include <cstring>
#include <limits>

#include "extract/sample_range.h"

namespace nacre {
namespace {

/// Comparisons per sample up to which counting beats a binary search.
constexpr int kCountedLevels = 12;

template <class T>
std::size_t table_index(T sample) {
  return static_cast<std::size_t>(static_cast<std::int64_t>(sample) -
                                  static_cast<std::int64_t>(std::numeric_limits<T>::min()));
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
    for (std::size_t i = 0; i < samples.size(); ++i) classes[i] = rank(samples[i]);
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
void SampleClasses<T>::of_row(std::span<const T> row, std::uint8_t* classes,
                              ClassRange* bricks) const {
  const std::size_t count = brick_count(row.size());
  for (std::size_t b = 0; b < count; ++b) {
    const std::size_t begin = b * kBrickCells;
    const auto samples = row.subspan(begin, std::min(kBrickCells + 1, row.size() - begin));
    const auto [least, largest] = sample_range(samples);
    const std::uint8_t lo = rank(least);
    const std::uint8_t hi = rank(largest);
    if (lo == hi) {
      std::memset(classes + begin, oriented(lo), samples.size());
    } else {
      of_samples(samples, lo, hi, classes + begin);
    }
    bricks[b] = {std::min(oriented(lo), oriented(hi)), std::max(oriented(lo), oriented(hi))};
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

#include "extract/stored_levels.h"

#include <algorithm>
#include <bit>
#include <concepts>
#include <limits>
#include <optional>
#include <type_traits>

namespace nacre {
namespace {

/// The finite samples of a type in ascending order, numbered from 0. Zero appears twice among
/// floats, as -0 and +0; they compare equal and do no harm.
template <std::integral T>
T nth_sample(std::uint64_t n) {
  return static_cast<T>(static_cast<std::int64_t>(n) +
                        static_cast<std::int64_t>(std::numeric_limits<T>::min()));
}

template <std::floating_point T>
T nth_sample(std::uint64_t n) {
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  constexpr Bits kSign = Bits{1} << (8 * sizeof(T) - 1);
  const auto largest = std::uint64_t{std::bit_cast<Bits>(std::numeric_limits<T>::max())};
  // Magnitudes count down among the negative numbers, then up.
  const Bits bits =
      n <= largest ? static_cast<Bits>(kSign | (largest - n)) : static_cast<Bits>(n - largest - 1);
  return std::bit_cast<T>(bits);
}

template <class T>
std::uint64_t number_of_samples() {
  if constexpr (std::integral<T>) {
    return std::uint64_t{1} << (8 * sizeof(T));
  } else {
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    return 2 * (std::uint64_t{std::bit_cast<Bits>(std::numeric_limits<T>::max())} + 1);
  }
}

/// The least n with predicate(nth_sample(n)), for a predicate that stays true once it is.
template <class T, class Predicate>
std::optional<std::uint64_t> first_sample(const Predicate& predicate) {
  std::uint64_t begin = 0;
  std::uint64_t end = number_of_samples<T>();
  const std::uint64_t none = end;
  while (begin < end) {
    const std::uint64_t middle = begin + (end - begin) / 2;
    if (predicate(nth_sample<T>(middle))) {
      end = middle;
    } else {
      begin = middle + 1;
    }
  }
  return begin == none ? std::nullopt : std::optional(begin);
}

}  // namespace

template <class T>
StoredLevels<T> stored_levels(std::span<const double> values, double slope, double intercept) {
  StoredLevels<T> levels;
  levels.descending = slope < 0.0;
  for (const double value : values) {
    const auto inside = [&](T stored) {
      return slope * static_cast<double>(stored) + intercept >= value;
    };
    const auto upper_side = [&](T stored) { return inside(stored) != levels.descending; };
    const std::optional<std::uint64_t> first = first_sample<T>(upper_side);
    // Nothing of the type is inside: neither this value nor the higher ones are reached.
    if (levels.descending ? first == 0 : !first) break;
    ++levels.count;
    levels.crossings.push_back(0.0);
    if (!first) continue;  // everything is inside, nothing ever crosses
    levels.thresholds.push_back(nth_sample<T>(*first));
    if (*first == 0) continue;
    levels.crossings.back() =
        std::clamp((value - intercept) / slope, static_cast<double>(nth_sample<T>(*first - 1)),
                   static_cast<double>(nth_sample<T>(*first)));
  }
  std::ranges::sort(levels.thresholds);
  return levels;
}

template StoredLevels<std::uint8_t> stored_levels(std::span<const double>, double, double);
template StoredLevels<std::int8_t> stored_levels(std::span<const double>, double, double);
template StoredLevels<std::uint16_t> stored_levels(std::span<const double>, double, double);
template StoredLevels<std::int16_t> stored_levels(std::span<const double>, double, double);
template StoredLevels<std::uint32_t> stored_levels(std::span<const double>, double, double);
template StoredLevels<std::int32_t> stored_levels(std::span<const double>, double, double);
template StoredLevels<float> stored_levels(std::span<const double>, double, double);
template StoredLevels<double> stored_levels(std::span<const double>, double, double);

}  // namespace nacre

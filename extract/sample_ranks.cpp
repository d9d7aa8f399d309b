#include "extract/sample_ranks.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <functional>
#include <limits>
#include <span>
#include <type_traits>

namespace nacre {
namespace {

constexpr int kDigitBits = 16;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
constexpr std::size_t kGrain = std::size_t{1} << 20;

template <std::size_t Size>
using UnsignedOfSize = std::conditional_t<
    Size == 1, std::uint8_t,
    std::conditional_t<Size == 2, std::uint16_t,
                       std::conditional_t<Size == 4, std::uint32_t, std::uint64_t>>>;

/// An unsigned code that orders like the samples.
template <class T>
auto code_of(T sample) {
  using Code = UnsignedOfSize<sizeof(T)>;
  constexpr Code kTop = static_cast<Code>(Code{1} << (8 * sizeof(T) - 1));
  if constexpr (std::is_floating_point_v<T>) {
    // -0 is 0; negative floats order backwards by their bits.
    const Code bits = std::bit_cast<Code>(sample == T{0} ? T{0} : sample);
    return static_cast<Code>((bits & kTop) != 0 ? ~bits : bits | kTop);
  } else if constexpr (std::is_signed_v<T>) {
    return static_cast<Code>(static_cast<Code>(sample) ^ kTop);
  } else {
    return static_cast<Code>(sample);
  }
}

template <class T>
T sample_of(UnsignedOfSize<sizeof(T)> code) {
  using Code = UnsignedOfSize<sizeof(T)>;
  constexpr Code kTop = static_cast<Code>(Code{1} << (8 * sizeof(T) - 1));
  if constexpr (std::is_floating_point_v<T>) {
    return std::bit_cast<T>(static_cast<Code>((code & kTop) != 0 ? code & ~kTop : ~code));
  } else if constexpr (std::is_signed_v<T>) {
    return static_cast<T>(code ^ kTop);
  } else {
    return static_cast<T>(code);
  }
}

using Counts = std::vector<std::uint64_t>;

Counts sum_of(Counts a, const Counts& b) {
  std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus<>());
  return a;
}

/// Counts the samples whose code starts with `prefix` (its bits from `shift + kDigitBits` up), by
/// the 16 bits above `shift`. Sums of integers: the same in any order.
template <class T>
Counts count_digits(std::span<const T> samples, std::uint64_t prefix, int shift) {
  const auto upper_of = [shift](std::uint64_t code) {
    return shift + kDigitBits >= 64 ? std::uint64_t{0} : code >> (shift + kDigitBits);
  };
  const auto count = [&](const tbb::blocked_range<std::size_t>& range, Counts counts) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const std::uint64_t code = code_of(samples[i]);
      if (upper_of(code) == prefix) ++counts[(code >> shift) & (kDigits - 1)];
    }
    return counts;
  };
  return tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, samples.size(), kGrain),
                              Counts(kDigits, 0), count, sum_of);
}

/// The highest digit's shift for a type: types of up to 16 bits have one digit.
template <class T>
constexpr int top_shift() {
  return sizeof(T) <= 2 ? 0 : static_cast<int>(8 * sizeof(T)) - kDigitBits;
}

/// The digit that holds a rank; the rank becomes the one within it.
std::uint64_t digit_at(const Counts& counts, std::uint64_t& rank) {
  std::uint64_t digit = 0;
  while (rank >= counts[digit]) rank -= counts[digit++];
  return digit;
}

}  // namespace

SampleRanks::SampleRanks(const Volume& volume) : volume_(volume), count_(sample_count(volume)) {
  upper_counts_ = visit_samples(volume, []<class T>(std::span<const T> samples) {
    return count_digits(samples, 0, top_shift<T>());
  });
}

double SampleRanks::value_at(std::uint64_t rank) const {
  return volume_.slope * stored_at(rank) + volume_.intercept;
}

double SampleRanks::stored_at(std::uint64_t rank) const {
  assert(rank < count_);
  if (volume_.slope < 0.0) rank = count_ - 1 - rank;
  return visit_samples(volume_, [&]<class T>(std::span<const T> samples) {
    std::uint64_t code = digit_at(upper_counts_, rank);
    for (int shift = top_shift<T>() - kDigitBits; shift >= 0; shift -= kDigitBits) {
      code = code << kDigitBits | digit_at(count_digits(samples, code, shift), rank);
    }
    return static_cast<double>(sample_of<T>(static_cast<UnsignedOfSize<sizeof(T)>>(code)));
  });
}

std::uint64_t SampleRanks::count_of_least() const {
  const double least = stored_at(0);
  return visit_samples(volume_, [&]<class T>(std::span<const T> samples) {
    const auto stored = static_cast<T>(least);
    const auto count = [&](const tbb::blocked_range<std::size_t>& range, std::uint64_t sum) {
      const auto part = samples.subspan(range.begin(), range.size());
      return sum + static_cast<std::uint64_t>(std::count(part.begin(), part.end(), stored));
    };
    return tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, samples.size(), kGrain),
                                std::uint64_t{0}, count, std::plus<>());
  });
}

}  // namespace nacre

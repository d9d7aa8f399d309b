#include "extract/default_window.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "extract/sample_ranks.h"

namespace nacre {
namespace {

constexpr double kSaturated = 0.0005;
constexpr double kManyAtLeast = 0.25;  // air or a mask, not tissue
constexpr double kRemoved = 0.05;      // this little is left above a removed background
constexpr double kOneSigma = 0.8413447460685429;
constexpr double kSigmas = 3.0;
constexpr double kFractionRemoved = 0.08;
constexpr double kFractionMost = 0.6;

/// a + s (b - a) without overflow.
double mix(double a, double b, double s) { return a * (1.0 - s) + b * s; }

/// The value at a fraction of the samples from `first` on.
double quantile(const SampleRanks& ranks, std::uint64_t first, double fraction) {
  const auto rest = static_cast<double>(ranks.count() - first);
  const auto offset = static_cast<std::uint64_t>(fraction * rest);
  return ranks.value_at(std::min(first + offset, ranks.count() - 1));
}

Window around(double value) {
  constexpr double most = std::numeric_limits<double>::max();
  const double step = std::max(1.0, std::abs(value) * 1e-6);
  return {std::max(value - step, -most), std::min(value + step, most)};
}

double default_lo(const SampleRanks& ranks, double least, double hi) {
  const auto total = static_cast<double>(ranks.count());
  const std::uint64_t at_least = ranks.count_of_least();
  const double above = 1.0 - static_cast<double>(at_least) / total;
  if (above <= kRemoved) return mix(least, hi, kFractionRemoved);
  const std::uint64_t first = above <= 1.0 - kManyAtLeast ? at_least : 0;
  const double median = quantile(ranks, first, 0.5);
  const double spread = quantile(ranks, first, kOneSigma) - median;
  return std::min(median + kSigmas * spread, mix(least, hi, kFractionMost));
}

}  // namespace

Window default_window(const Volume& volume) {
  const SampleRanks ranks(volume);
  const double least = ranks.value_at(0);
  const double greatest = ranks.value_at(ranks.count() - 1);
  if (!(least < greatest)) return around(least);
  const auto saturated =
      static_cast<std::uint64_t>(kSaturated * static_cast<double>(ranks.count()));
  double hi = ranks.value_at(ranks.count() - 1 - saturated);
  if (!(hi > least)) hi = greatest;  // next to nothing is above the least value: show that
  const double lo = default_lo(ranks, least, hi);
  return lo < hi ? Window{lo, hi} : Window{least, hi};
}

}  // namespace nacre

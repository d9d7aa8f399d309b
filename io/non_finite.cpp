#include "io/non_finite.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "io/bad_file.h"

namespace nacre {
namespace {

struct Range {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
};

/// Smallest and largest finite stored number; counts the rest.
template <class T>
Range finite_range(std::span<const T> samples, VolumeReadReport& report) {
  constexpr T max = std::numeric_limits<T>::max();
  T lowest = max;
  T highest = -max;
  bool any = false;
  for (const T sample : samples) {
    if (std::abs(sample) <= max) {
      lowest = std::min(lowest, sample);
      highest = std::max(highest, sample);
      any = true;
    } else if (std::isnan(sample)) {
      ++report.nan_count;
    } else if (sample > 0) {
      ++report.positive_infinity_count;
    } else {
      ++report.negative_infinity_count;
    }
  }
  return any ? Range{lowest, highest} : Range{};
}

template <class T>
void replace(std::span<T> samples, const Range& range, T nan_becomes) {
  for (T& sample : samples) {
    if (std::isnan(sample)) sample = nan_becomes;
    sample = std::clamp(sample, static_cast<T>(range.lowest), static_cast<T>(range.highest));
  }
}

template <class T>
Range replace_in(const std::filesystem::path& path, Volume& volume, VolumeReadReport& report) {
  const std::span<T> samples = samples_as<T>(volume);
  const Range range = finite_range<T>(samples, report);
  if (range.lowest > range.highest) {
    throw_bad_file(path, "no finite sample", "at least one");
  }
  if (report.nan_count + report.positive_infinity_count + report.negative_infinity_count > 0) {
    const double nan_becomes = volume.slope > 0 ? range.lowest : range.highest;
    replace<T>(samples, range, static_cast<T>(nan_becomes));
  }
  return range;
}

}  // namespace

void replace_non_finite(const std::filesystem::path& path, Volume& volume,
                        VolumeReadReport& report) {
  const Range range = visit_scalar_type(volume.type, [&](auto zero) {
    using T = decltype(zero);
    if constexpr (std::is_floating_point_v<T>) return replace_in<T>(path, volume, report);
    return Range{static_cast<double>(std::numeric_limits<T>::lowest()),
                 static_cast<double>(std::numeric_limits<T>::max())};
  });
  const double first = volume.slope * range.lowest + volume.intercept;
  const double second = volume.slope * range.highest + volume.intercept;
  if (!std::isfinite(first) || !std::isfinite(second) || !std::isfinite(second - first)) {
    throw_bad_file(path,
                   fmt::format("samples from {} to {} with slope {} and intercept {}", range.lowest,
                               range.highest, volume.slope, volume.intercept),
                   "values within the range of a double");
  }
}

}  // namespace nacre

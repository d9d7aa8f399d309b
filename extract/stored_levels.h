#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nacre {

/// Contour values in terms of the stored samples, so that a sweep compares what is stored.
///
/// The *class* of a sample is the number of values v_k with slope * stored + intercept >= v_k, the
/// left side as evaluated in double. That product and sum are monotone in the stored sample, also
/// rounded, so that each value has an exact threshold among the samples of the type:
///
///     class(s) = c0 + q(s)  or, for a negative slope,  c0 - q(s),    q(s) = #{ thresholds <= s }.
template <class T>
struct StoredLevels {
  std::vector<T> thresholds;  ///< ascending, equal ones repeated
  bool descending = false;    ///< the slope is negative
  /// Number of values some sample of the type reaches: the first ones. The others' sets are empty.
  std::size_t count = 0;
  /// For each reached value the real number at which stored samples cross it, (v_k - intercept) /
  /// slope, clamped between the two neighbouring samples of the type that its threshold separates.
  std::vector<double> crossings;
};

/// @param values  ascending, at most 255
template <class T>
StoredLevels<T> stored_levels(std::span<const double> values, double slope, double intercept);

}  // namespace nacre

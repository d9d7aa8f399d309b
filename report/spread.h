#pragma once

#include <vector>

namespace nacre {

/// The middle of repeated measurements, and how far they scatter.
struct Spread {
  double median = 0.0;
  double lower = 0.0;  ///< first quartile
  double upper = 0.0;  ///< third quartile
  int samples = 0;
};

/// Quantiles interpolated linearly between order statistics: the q-quantile of n samples lies at
/// q (n - 1). Zeros for no samples.
Spread spread_of(std::vector<double> samples);

}  // namespace nacre

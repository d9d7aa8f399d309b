#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace nacre {

/// An emission level t, contoured, and the emission r shown for the layer from it to the next one.
struct Level {
  double emission = 0.0;        ///< t, in (0, 1]
  double representative = 0.0;  ///< r
  /// What sums show; none where it is the representative.
  std::optional<double> sum_representative = std::nullopt;
};

/// N uniform levels, the midpoint rule: t_k = (k - 1/2) / N, r_k = k / N, k = 1 to N. Each
/// representative is the middle of its layer, and the full emission shows as 1.
///
/// @param count   at least 1
/// @throws Error  BadArgument otherwise
std::vector<Level> uniform_levels(std::size_t count);

/// The given levels, with the middles of their layers as representatives: r_k = (t_k + t_(k+1)) / 2
/// and r_n = 1.
///
/// @param emissions  at least one, strictly ascending, in (0, 1]
/// @throws Error     BadArgument otherwise
std::vector<Level> explicit_levels(std::span<const double> emissions);

}  // namespace nacre

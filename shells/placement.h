#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/progress.h"
#include "core/volume_geometry.h"
#include "extract/levels.h"
#include "reference/exact_walk.h"

namespace nacre {

/// Values in ascending groups: how many, their sum, the sum of their squares.
struct ValueGroup {
  double least = 0.0;
  double greatest = 0.0;
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
};

/// The lit pixels of a volume's maximum projections over directions, as groups of emissions.
struct MaximumHistogram {
  std::vector<ValueGroup> groups;  ///< ascending, apart from each other; emissions above 0
};

struct HistogramOptions {
  int directions =
      24;          ///< over a hemisphere (a Fibonacci lattice): seen from behind, maxima are equal
  int size = 160;  ///< pixels along a picture's side
  ProgressCallback progress = {};  ///< stage "directions"
};

/// Groups emissions: equal ones together, close ones where there are more than some thousands.
/// @param emissions  in any order; those that are 0 are not lit and left out
MaximumHistogram make_histogram(std::vector<double> emissions);

/// The histogram of what maximum projections show, from exact pictures over directions. The same
/// for any number of threads.
MaximumHistogram maximum_histogram(const ExactWalk& walk, const BoundingSphere& sphere,
                                   const HistogramOptions& options = {});

/// The levels and representatives for which ideal shells' maximum projections have the least mean
/// squared error: the optimal scalar quantiser of the lit pixels (Lloyd 1982, "Least squares
/// quantization in PCM"; Max 1960, "Quantizing for minimum distortion"), its lowest value held at
/// 0.
///
/// Not a local optimum: dynamic programming over the histogram's groups (Bruce 1965, "Optimum
/// quantization"), with monotone splits, then each level in the middle between what is shown below
/// and above it. See docs/derivations.md, "Levels for the maximum projection". r_k is the mean of
/// the pixels in layer k; sums show the middle of the layer.
///
/// @param count   at least 1
/// @return        `count` levels, or as many as there are different emissions; `uniform_levels`
///                where nothing is lit
/// @throws Error  BadArgument if the count is 0
/// O(count * groups * log(groups)).
std::vector<Level> optimal_levels(const MaximumHistogram& histogram, std::size_t count);

/// The same levels with the means of the pixels in their layers as representatives, the middle of
/// the layer for sums (and where no pixel is in it).
std::vector<Level> with_mean_representatives(std::span<const Level> levels,
                                             const MaximumHistogram& histogram);

/// Mean squared error over lit pixels of the maximum projection of ideal shells (surfaces exactly
/// on their levels).
double predicted_error(std::span<const Level> levels, const MaximumHistogram& histogram);

}  // namespace nacre

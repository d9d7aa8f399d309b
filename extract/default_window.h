#pragma once

#include "core/volume.h"

namespace nacre {

/// Values shown as emission 0 and 1.
struct Window {
  double lo;
  double hi;
};

/// A window as angiograms are usually shown: background tissue dark, vessels graded, and of all
/// voxels at most the brightest 0.05 percent saturated.
///
/// hi is the value that at most 0.05 percent of the voxels exceed. For lo, the background is what
/// is not at the least value (if a quarter or more of the voxels are: air, or a mask): with median
/// m and upper spread s (84.13th percentile less the median: one standard deviation of a normal
/// distribution), lo = m + 3 s, so that tissue is dark, but never above 0.6 of the way from the
/// least value to hi. Where at most 5 percent of the voxels are above the least value the
/// background has been removed already, and lo = 0.08 of the way. Always lo < hi; a constant volume
/// c gets [c - 1, c + 1] (or the least window around c that doubles can tell apart).
///
/// Exact order statistics, so the same for any number of threads; a few passes over the volume.
Window default_window(const Volume& volume);

}  // namespace nacre

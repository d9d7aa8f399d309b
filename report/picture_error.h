#pragma once

#include <cstddef>

#include "core/image.h"

namespace nacre {

/// How far a picture is from the truth, over some of its pixels.
struct PictureError {
  std::size_t pixels = 0;
  double rmse = 0.0;       ///< root of the mean squared difference, in the pictures' unit
  double psnr_db = 0.0;    ///< 20 log10(peak / rmse); infinite where rmse is 0
  double max_error = 0.0;  ///< largest absolute difference
  double bias = 0.0;       ///< mean of picture - truth
};

/// The error over all pixels, and over the lit ones: those where the truth shows anything (> 0).
///
/// The lit figure is the headline: nine tenths of an angiogram are black, and flatter.
struct PictureComparison {
  PictureError all;
  PictureError lit;
  double peak = 1.0;
  int worst_x = 0;  ///< pixel of the largest difference
  int worst_y = 0;
};

/// Compares a picture with the truth.
///
/// @param peak    the brightness PSNR is taken against: 1 for max, the truth's largest for sum
/// @throws Error  BadArgument if the sizes differ or the peak is not positive
PictureComparison compare_pictures(const Image& picture, const Image& truth, double peak);

/// picture - truth, per pixel.
/// @throws Error  BadArgument if the sizes differ
Image difference(const Image& picture, const Image& truth);

/// The difference as a signed picture for the eye: black where equal, red where the picture is too
/// bright, blue where it is too dark; full colour at 1 / gain.
DisplayImage difference_picture(const Image& difference, double gain);

}  // namespace nacre

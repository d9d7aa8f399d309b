#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"

namespace nacre {

/// A picture on the way from the truth to the one that was made, and what tells it from the one
/// before it on that way.
struct ErrorStage {
  std::string cause;
  Image picture;
};

/// What one cause adds to a picture's error.
struct ErrorPart {
  std::string cause;
  double rmse = 0.0;       ///< of the cause's difference d, over all pixels, in the pictures' unit
  double rmse_lit = 0.0;   ///< the same over the pixels where the truth shows anything (> 0)
  double max_error = 0.0;  ///< largest |d|
  double bias = 0.0;       ///< mean of d over all pixels
  /// <d, D> / <D, D>, with D the sum of all differences: the cause's part of the total squared
  /// error. Negative for a cause that undoes what others did; 0 if there is no error.
  double share = 0.0;
};

/// A picture's error, split into its causes.
struct ErrorSplit {
  std::vector<ErrorPart> parts;  ///< in the order of the stages
  ErrorPart total;               ///< of the last picture against the truth; its share is 1 (or 0)
  std::size_t dominant = 0;      ///< index of the part with the largest share; the first of equals
};

/// Splits the error of the last stage's picture against the truth.
///
/// Stage i differs from the one before it by d_i, so D = sum of d_i is the error, and with
/// <a, b> the sum of a b over all pixels
///
///     <D, D> = sum over i of <d_i, D>:
///
/// the shares add up to 1, to rounding, and to the measured squared error whether or not causes are
/// correlated (docs/derivations.md, R3).
///
/// @throws Error  BadArgument without stages, or if sizes differ
ErrorSplit split_error(const Image& truth, std::span<const ErrorStage> stages);

}  // namespace nacre

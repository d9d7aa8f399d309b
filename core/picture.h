#pragma once

#include <limits>

namespace nacre {

/// What a picture shows along each ray.
enum class PictureMode {
  Max,    ///< the largest cued emission, [H96] eq. 4
  Sum,    ///< the cued emission integral over distance, emission * mm, [H96] eq. 2
  Count,  ///< each crossing adds its shell's brightness, [H96] section 2.1
  Iso,    ///< the lit shells
};

/// Depth cue beta(z) = beta0 + (a z + b), [H96] section 3, with z as in `depth_z`. The default is
/// none: beta = 1.
struct DepthCue {
  double a = 0.0;
  double b = 1.0;
  double beta0 = 0.0;
};

/// The part of each ray that shows: from `near_mm` to `far_mm` along the viewing direction,
/// measured from the sphere's centre, positive away from the eye (see `slab_depth_mm`).
struct Slab {
  double near_mm = -std::numeric_limits<double>::infinity();
  double far_mm = std::numeric_limits<double>::infinity();
};

}  // namespace nacre

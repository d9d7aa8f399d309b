#pragma once

#include <limits>

#include "core/camera.h"

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

/// beta(z) = beta0 + (a z + b).
inline double beta(const DepthCue& cue, double z) noexcept {
  return cue.beta0 + (cue.a * z + cue.b);
}

/// Whether beta is the same at all depths.
inline bool is_flat(const DepthCue& cue) noexcept { return cue.a == 0.0; }

/// @throws Error  BadArgument unless beta(0) and beta(1) are finite and not negative
void check_cue(const DepthCue& cue);

/// The part of each ray that shows: from `near_mm` to `far_mm` along the viewing direction,
/// measured from the sphere's centre, positive away from the eye (see `slab_depth_mm`).
struct Slab {
  double near_mm = -std::numeric_limits<double>::infinity();
  double far_mm = std::numeric_limits<double>::infinity();
};

/// @throws Error  BadArgument unless near_mm < far_mm (infinite ends are fine)
void check_slab(const Slab& slab);

/// What a camera shows of a ray, in mm from its origin; infinite ends are allowed.
struct RayInterval {
  double t_begin_mm = -std::numeric_limits<double>::infinity();
  double t_end_mm = std::numeric_limits<double>::infinity();
};

/// The part of a ray in front of the eye and inside the slab.
RayInterval visible_interval(const Camera& camera, const Ray& ray, const Slab& slab);

/// Brightness of a lit surface under a headlight: light from where the eye is, so that a surface
/// shines with the cosine between its normal and the way to the eye (Lambert), over a little light
/// from everywhere, which keeps what is turned away from black:
///
///     0.2 + 0.8 max(0, cosine).
///
/// Shells are lit on their outside only: the cosine is negative inside. Tools are lit on both
/// sides: the cosine is an absolute value there, because their meshes are not always closed.
inline constexpr double kAmbient = 0.2;
inline double headlight(double cosine) noexcept {
  return kAmbient + (1.0 - kAmbient) * (cosine > 0.0 ? cosine : 0.0);
}

}  // namespace nacre

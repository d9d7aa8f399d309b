#pragma once

#include <glm/vec3.hpp>

#include "core/camera.h"
#include "core/picture.h"

namespace nacre {

/// A depth cue as what it is in space, a linear function of position:
///
///     beta(p) = at_center + rise_per_mm . (p - center_mm).
///
/// Along a ray it is linear in t, in perspective too: depth is measured along the viewing
/// direction (docs/derivations.md, section 2.5). The default is no cue, 1 everywhere.
struct CueField {
  double at_center = 1.0;
  glm::dvec3 center_mm{0.0};    ///< LPS
  glm::dvec3 rise_per_mm{0.0};  ///< beta's gradient
};

/// The cue of a camera, about the centre of its sphere, where z = 1/2.
CueField cue_field(const DepthCue& cue, const Camera& camera) noexcept;

/// Whether the cue is the same everywhere: then it is a factor.
inline bool is_flat(const CueField& cue) noexcept { return cue.rise_per_mm == glm::dvec3(0.0); }

}  // namespace nacre

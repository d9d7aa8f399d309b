#include "reference/cue_field.h"

namespace nacre {

CueField cue_field(const DepthCue& cue, const Camera& camera) noexcept {
  // z = (R - depth) / (2 R), so that beta falls by a / (2 R) a millimetre away from the eye.
  return {beta(cue, 0.5), camera.sphere.center_mm,
          -(0.5 * cue.a / camera.sphere.radius_mm) * camera.forward};
}

}  // namespace nacre

#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "datasets/head_anatomy.h"

namespace nacre {

/// What surrounds the arteries: a folded brain with its ventricles, fluid, skull and scalp, as
/// smooth signals in the angiogram's values (air 0, fluid 110, bone 45, brain about 250, fat 290).
class HeadTissue {
 public:
  explicit HeadTissue(std::uint64_t seed);

  /// Signal at a point, LPS mm.
  double signal(const glm::dvec3& p_mm) const;

 private:
  double brain_signal(const glm::dvec3& p_mm, double scale, double folding) const;

  BrainShape brain_;
  std::uint64_t folding_seed_;
};

/// The receiving coils' gain: 1 in the middle, more near the coils around the head, a little less
/// at the slab's ends.
double coil_gain(const glm::dvec3& p_mm);

}  // namespace nacre

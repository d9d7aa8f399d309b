#pragma once

#include <glm/vec3.hpp>

#include "core/emission.h"
#include "shells/surface_field.h"
#include "shells/trilinear_field.h"

namespace nacre {

/// How far off its level a surface is, in emission units, signed: phi(p) - t_k and its gradient.
///
/// Never less than |phi - t_k| (`LevelError`): where phi is clamped, beyond the map's first and
/// last knot, its outermost slopes go on, so that the error tells how far a surface strays there
/// too. On the volume's border a point inside the set is where it belongs: error and gradient are
/// 0. Beyond the border nothing belongs: the error is 1.
class LevelField {
 public:
  /// @param field  must outlive this
  /// @param level  t_k, reached by the map
  LevelField(const TrilinearField& field, const EmissionMap& emission, double level);

  /// @param p_mm  LPS, relative to the centre of the volume's box
  FieldSample operator()(const glm::dvec3& p_mm) const noexcept;

 private:
  const TrilinearField& field_;
  const EmissionMap emission_;
  double level_;
  double slope_below_;  ///< of the emission by the value, under the first knot
  double slope_above_;  ///< and over the last
  double lo_;           ///< a piece of the map around the level: from here
  double hi_;           ///< to here
  double slope_;        ///< it rises so much
  double value_;        ///< and is the level here
};

}  // namespace nacre

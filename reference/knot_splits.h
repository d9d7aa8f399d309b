#pragma once

#include <algorithm>

#include "core/emission.h"
#include "reference/cubic.h"

namespace nacre {

/// Whether a knot lies strictly between two values: only such a knot can be crossed.
inline bool any_knot_between(const EmissionMap& map, double least, double greatest) {
  const auto knots = map.knots();
  return std::any_of(knots.begin(), knots.end(), [=](const EmissionKnot& knot) {
    return knot.value > least && knot.value < greatest;
  });
}

/// Splits [0, 1] where f crosses knots of the map, and calls `on_part(s0, s1, knots_below)` for the
/// parts in their order: over each, T(f) keeps to the linear piece above `knots_below` knots. Parts
/// may be of no length.
template <class OnPart>
void for_each_piece(const EmissionMap& map, const BernsteinCubic& f, OnPart&& on_part) {
  const auto knots = map.knots();
  const auto value = [knots](std::size_t knot) { return knots[knot].value; };
  const auto at_start = static_cast<std::size_t>(
      std::find_if(knots.begin(), knots.end(),
                   [&f](const EmissionKnot& knot) { return knot.value > f.b[0]; }) -
      knots.begin());
  double s0 = 0.0;
  const std::size_t at_end =
      follow_crossings(f, knots.size(), value, at_start, [&](std::size_t knot, double s, bool up) {
        on_part(s0, s, up ? knot : knot + 1);
        s0 = s;
        return true;
      });
  on_part(s0, 1.0, at_end);
}

}  // namespace nacre

#pragma once

#include "core/emission.h"
#include "reference/cubic.h"

namespace nacre {

/// Mean emission over a cubic's unit interval: the integral of T(f(s)) for s from 0 to 1, exactly.
///
/// T is linear between knots, and the mean of a cubic is the mean of its Bernstein coefficients; so
/// the interval is split where f crosses a knot, and each part has a closed form
/// (docs/derivations.md, section 2.3).
///
/// @param map  knots in the unit of f
double mean_emission(const EmissionMap& map, const BernsteinCubic& f);

}  // namespace nacre

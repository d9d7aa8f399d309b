#pragma once

#include "reference/cued_emission.h"
#include "reference/walk_field.h"

namespace nacre {

/// The integral of T(value) along a line, emission * mm.
double emission_integral(const WalkField& field, const CellLine& line,
                         const LineInterval& interval);

/// The integral of beta(t) T(value) along a line, emission * mm.
/// @param emission  the field's map
double cued_emission_integral(const WalkField& field, const CuedEmission& emission,
                              const CellLine& line, const LineInterval& interval,
                              const LineCue& beta);

}  // namespace nacre

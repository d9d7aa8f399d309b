#pragma once

#include "reference/cued_emission.h"
#include "reference/walk_field.h"

namespace nacre {

/// The largest value along a line, in field units: from `floor` up, and no farther than it takes to
/// reach `ceiling`. `floor` where nothing exceeds it.
double max_field(const WalkField& field, const CellLine& line, const LineInterval& interval,
                 double floor, double ceiling);

/// max { beta(t) T(value) } along a line, at least 0.
///
/// The walk goes the way that beta falls: what is bright is then met early, and it ends where the
/// brightest that the volume holds could not win any more.
///
/// @param emission  the field's map
double max_cued_emission(const WalkField& field, const CuedEmission& emission, const CellLine& line,
                         const LineInterval& interval, const LineCue& beta);

}  // namespace nacre

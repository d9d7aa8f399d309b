#pragma once

#include "reference/cell_cue.h"
#include "reference/walk_field.h"

namespace nacre {

/// The most emission that rounding of places and samples to floats may come to: steps of places of
/// some 4 times the cells along the volume, times the steepest slopes of samples and map. Infinity
/// where no float holds a sample.
double rounding_to_floats(const WalkField& field);

/// Whether floats hold a cue anywhere in the volume.
bool floats_hold(const WalkField& field, const CellCue& cue);

}  // namespace nacre

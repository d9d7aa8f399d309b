#pragma once

#include "reference/layer_ladder.h"
#include "reference/walk_field.h"

namespace nacre {

/// The largest beta(t) r_k over the shells k around the line's points; at least 0
/// (docs/derivations.md, section 2.7).
double max_layer_emission(const WalkField& field, const LayerLadder& ladder, const CellLine& line,
                          const LineInterval& interval, const LineCue& beta);

/// The integral of beta(t) r_n along a line, n the layer: emission * mm.
double layer_emission_integral(const WalkField& field, const LayerLadder& ladder,
                               const CellLine& line, const LineInterval& interval,
                               const LineCue& beta);

}  // namespace nacre

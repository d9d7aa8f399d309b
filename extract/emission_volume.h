#pragma once

#include <vector>

#include "core/emission.h"
#include "core/volume.h"

namespace nacre {

/// A volume and the rising emission map of its values.
struct EmissionVolume {
  Volume volume;
  EmissionMap emission;
};

/// Makes any piecewise-linear map a rising one, changing the volume where that is needed.
///
/// A map that never falls stays as it is. One that never rises becomes rising by negating slope and
/// intercept: the samples are not touched, interpolation stays exact. One that rises and falls is
/// applied at the voxels, and the result, f32 emission from 0 to 1, is the volume from there on.
///
/// @param knots   at least two, values strictly rising and finite, emissions in [0, 1], not all
/// equal
/// @throws Error  BadArgument otherwise
EmissionVolume map_volume(Volume volume, std::vector<EmissionKnot> knots);

}  // namespace nacre

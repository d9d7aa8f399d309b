#pragma once

#include <filesystem>

#include "core/volume.h"
#include "io/volume_read_report.h"

namespace nacre {

/// Replaces what is not finite, once and for all: NaN becomes the sample with the lowest finite
/// *value* (slope applied) present, positive and negative infinity the largest and smallest finite
/// *stored* number present. Counts go into the report.
///
/// @throws Error  BadFile if no sample is finite, or if `slope * stored + intercept`, or the
///                distance between two such values, overflows a double
void replace_non_finite(const std::filesystem::path& path, Volume& volume,
                        VolumeReadReport& report);

}  // namespace nacre

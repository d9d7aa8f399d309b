#pragma once

#include "io/volume_read_report.h"

namespace nacre {

/// Millimetres in one of a named unit of length. Nothing named (null or empty): 1. A name that is
/// not known: 1, with a warning.
double mm_per_unit(const char* name, VolumeReadReport& report);

}  // namespace nacre

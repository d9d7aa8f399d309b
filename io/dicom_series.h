#pragma once

#include <filesystem>
#include <string>

#include "core/volume.h"
#include "io/volume_read_report.h"

namespace nacre {

/// Reads a DICOM series: a folder with one file a slice, in any order and under any names, perhaps
/// among other files.
///
/// Order, spacing and shear come from the positions of the slices alone (see slice_stack.h), never
/// from SliceThickness or SpacingBetweenSlices. The stored type is kept; slope and intercept too if
/// all slices have the same, else the values are stored as f32. Compressed transfer syntaxes work
/// as far as GDCM decodes them.
///
/// @param series_uid  SeriesInstanceUID; empty: the only one in the folder
/// @throws Error      BadArgument if the folder holds several series and none, or one that is not
///                    there, is chosen; BadFile for a folder without DICOM images, colour,
///                    multi-frame files, and slices that do not make a grid; Unsupported in a build
///                    without GDCM
Volume read_dicom_series(const std::filesystem::path& folder, const std::string& series_uid,
                         VolumeReadReport& report);

}  // namespace nacre

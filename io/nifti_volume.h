#pragma once

#include <filesystem>

#include "core/volume.h"
#include "io/volume_read_report.h"

namespace nacre {

/// Reads a NIfTI-1 or NIfTI-2 volume: .nii, .hdr with .img, each also gzipped.
///
/// The frame is the sform where its code is positive, else the qform, else the pixel sizes alone
/// (RAS assumed, with a warning); RAS becomes LPS and metres or microns become millimetres.
/// scl_slope and scl_inter become the volume's slope and intercept.
///
/// @throws Error  BadFile for what is damaged, has more than three dimensions, is coloured, complex
///                or of an exotic type, or is an ANALYZE 7.5 file (which says no orientation)
Volume read_nifti(const std::filesystem::path& path, VolumeReadReport& report);

}  // namespace nacre

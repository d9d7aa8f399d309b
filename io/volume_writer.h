#pragma once

#include <filesystem>

#include "core/volume.h"

namespace nacre {

/// Writes a volume in the format of its name's extension: .nrrd (gzip), .nhdr and .mhd (the samples
/// in a .raw file beside them), .mha, .nii, .nii.gz.
///
/// Reading it back gives the same bytes, slope and intercept, and the same `world_from_voxel` to
/// the last bit. NIfTI-1 is written where its 32-bit numbers can hold that, else NIfTI-2. Files
/// appear under their names only when they are whole.
///
/// @throws Error  BadArgument for another extension or a place where no file can be created;
///                Unsupported for what the format cannot say (a slope in NRRD, more than 2^31 - 1
///                samples along an axis in MetaImage), and where writing fails
void write_volume(const Volume& volume, const std::filesystem::path& path);

/// Refuses a name that `write_volume` would refuse, before the work of making the volume.
/// @throws Error  BadArgument for an extension that names no format
void require_volume_name(const std::filesystem::path& path);

}  // namespace nacre

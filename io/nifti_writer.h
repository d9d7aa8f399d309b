#pragma once

#include <filesystem>

#include "core/volume.h"

namespace nacre {

/// Writes a volume as NIfTI; see volume_writer.h, which chooses the format by the name.
/// @throws Error  BadArgument or Unsupported
void write_nifti(const Volume& volume, const std::filesystem::path& path);

}  // namespace nacre

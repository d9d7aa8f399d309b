#pragma once

#include <filesystem>

#include "core/volume.h"
#include "io/volume_read_report.h"

namespace nacre {

/// Reads a MetaImage volume: .mha, or .mhd with its data files; raw or zlib-compressed.
///
/// The frame is LPS; a file without directions has its axes along it. The intensity slope and
/// offset become the volume's slope and intercept, and DistanceUnits become millimetres.
///
/// @throws Error  BadFile for what is damaged, has more than three axes of more than one sample, or
///                more than one channel; Unsupported in a build without ITK
Volume read_metaimage(const std::filesystem::path& path, VolumeReadReport& report);

}  // namespace nacre

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/volume.h"
#include "io/raw_volume.h"
#include "io/volume_crop.h"
#include "io/volume_read_report.h"

namespace nacre {

/// How to read a volume, where the file alone does not say it.
struct VolumeReadOptions {
  std::optional<RawHeader> raw =
      {};  ///< the file holds bare samples of this kind, whatever its name
  std::optional<VoxelCrop> crop = {};  ///< keep these voxels only, both ends included
  std::string dicom_series = {};       ///< SeriesInstanceUID; empty: the only one in the folder
};

/// A volume, and what reading it found out.
struct VolumeFile {
  Volume volume;
  VolumeReadReport report;
};

/// Reads a volume: NIfTI (.nii, .nii.gz, .hdr or .img), NRRD (.nrrd, .nhdr), MetaImage (.mha,
/// .mhd), a DICOM series (a folder), or bare samples (`options.raw`).
///
/// The samples stay in their stored type, with the file's slope and intercept beside them; samples
/// that are not finite are replaced (see VolumeReadReport), over the whole volume, before a crop.
/// `world_from_voxel` is in LPS millimetres as the file states it, shear included. A 2-dimensional
/// file is a volume of one slice. Peak memory: the volume plus a few megabytes, and the crop.
///
/// The libraries underneath keep state of their own: read from one thread at a time.
///
/// @throws Error  BadFile for what is missing, damaged, or no scalar volume of three dimensions;
///                BadArgument for a crop outside the volume; Unsupported for formats this build was
///                made without
VolumeFile read_volume(const std::filesystem::path& path, const VolumeReadOptions& options = {});

}  // namespace nacre

#pragma once

#include <filesystem>
#include <glm/mat4x4.hpp>

#include "core/volume.h"
#include "io/volume_read_report.h"

namespace nacre {

/// Refuses a frame that no picture could show truly: numbers that are not finite, spacings outside
/// 1e-9 to 1e9 mm, voxel axes in one plane (|handedness| < 0.01). Warns of a shear above 0.1
/// degree, which `world_from_voxel` keeps exactly.
/// @throws Error  BadFile
void check_geometry(const std::filesystem::path& path, const glm::dmat4& world_from_voxel,
                    VolumeReadReport& report);

/// Sets slope and intercept as a file states them.
/// @throws Error  BadFile if the slope is 0 or either is not finite
void set_scaling(const std::filesystem::path& path, double slope, double intercept, Volume& volume);

}  // namespace nacre

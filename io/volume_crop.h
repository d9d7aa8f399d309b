#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string_view>

#include "core/volume.h"

namespace nacre {

/// A box of voxels. Both ends belong to it, so {first = 0, last = 0} is one voxel.
struct VoxelCrop {
  glm::i64vec3 first{0};
  glm::i64vec3 last{0};
};

/// Parses "X0,X1,Y0,Y1,Z0,Z1": voxel indices from 0, both ends included.
/// @throws Error  BadArgument
VoxelCrop parse_voxel_crop(std::string_view text);

/// The voxels of a box; `world_from_voxel` is shifted so that each stays where it was.
///
/// @param path    of the volume, for the message
/// @throws Error  BadArgument if the box is not within the volume
Volume crop_volume(const std::filesystem::path& path, const Volume& volume, const VoxelCrop& crop);

}  // namespace nacre

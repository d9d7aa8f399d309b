#include "io/volume_crop.h"

#include <fmt/core.h>

#include <cstring>

#include "core/error.h"
#include "io/number_list.h"

namespace nacre {

VoxelCrop parse_voxel_crop(std::string_view text) {
  const std::vector<std::string_view> parts = split(text, ',');
  VoxelCrop crop;
  bool good = parts.size() == 6;
  for (int axis = 0; good && axis < 3; ++axis) {
    const auto first = parse_number<std::int64_t>(parts[2 * static_cast<std::size_t>(axis)]);
    const auto last = parse_number<std::int64_t>(parts[2 * static_cast<std::size_t>(axis) + 1]);
    good = first && last && *first >= 0 && *first <= *last;
    if (good) crop.first[axis] = *first;
    if (good) crop.last[axis] = *last;
  }
  if (!good) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("crop: found \"{}\", expected X0,X1,Y0,Y1,Z0,Z1: voxel indices from 0, "
                            "both ends included, first <= last",
                            text));
  }
  return crop;
}

Volume crop_volume(const std::filesystem::path& path, const Volume& volume, const VoxelCrop& crop) {
  for (int axis = 0; axis < 3; ++axis) {
    if (crop.first[axis] < 0 || crop.first[axis] > crop.last[axis] ||
        crop.last[axis] >= volume.dims[axis]) {
      throw Error(
          ErrorCode::BadArgument,
          fmt::format("{}: found a crop from {} to {} along {}, expected voxels from 0 to {}",
                      path.string(), crop.first[axis], crop.last[axis], "xyz"[axis],
                      volume.dims[axis] - 1));
    }
  }
  Volume part = make_volume(crop.last - crop.first + glm::i64vec3(1), volume.type);
  part.slope = volume.slope;
  part.intercept = volume.intercept;
  part.world_from_voxel = volume.world_from_voxel;
  part.world_from_voxel[3] = volume.world_from_voxel * glm::dvec4(glm::dvec3(crop.first), 1.0);

  const std::size_t sample_size = size_of(volume.type);
  const std::size_t row_size = static_cast<std::size_t>(part.dims.x) * sample_size;
  std::byte* to = part.samples.data();
  for (std::int64_t z = crop.first.z; z <= crop.last.z; ++z) {
    for (std::int64_t y = crop.first.y; y <= crop.last.y; ++y) {
      const std::int64_t row = crop.first.x + volume.dims.x * (y + volume.dims.y * z);
      std::memcpy(to, volume.samples.data() + static_cast<std::size_t>(row) * sample_size,
                  row_size);
      to += row_size;
    }
  }
  return part;
}

}  // namespace nacre

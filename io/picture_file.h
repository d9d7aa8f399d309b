#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/image.h"
#include "core/picture.h"

namespace nacre {

/// A measured picture with what its file says of it.
struct PictureFile {
  Image image;
  std::optional<PictureMode> mode;  ///< if the file names it
};

/// The kinds of picture files, by their name's ending.
enum class PictureFormat {
  Png,
  Apng,  ///< animated
  Tiff,
};

/// @throws Error  BadArgument unless the name ends in .png, .tif, .tiff or .apng
PictureFormat picture_format(const std::filesystem::path& path);

/// Reads a float TIFF as it is, or a gray PNG (the first frame of an animated one) as pixels from 0
/// to 1.
///
/// @throws Error  BadFile if it is neither, damaged, or holds NaN
PictureFile read_picture(const std::filesystem::path& path);

/// The bytes of a float TIFF whose description names the mode and the unit.
std::vector<std::byte> encode_measured_picture(const Image& image, PictureMode mode);

/// Writes a float TIFF whose description names the mode and the unit.
void write_measured_picture(const Image& image, PictureMode mode,
                            const std::filesystem::path& path);

}  // namespace nacre

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/image.h"

namespace nacre {

/// A picture as the bytes of a TIFF file: float32, one channel, uncompressed.
///
/// @param description  goes into ImageDescription: what the pixels are, in which unit
std::vector<std::byte> encode_tiff(const Image& image, const std::string& description);

/// Writes a picture as TIFF: float32, one channel, uncompressed, under its name only when whole.
///
/// @param description  goes into ImageDescription: what the pixels are, in which unit
/// @throws Error       BadArgument for a name that cannot be written to
void write_tiff(const Image& image, const std::filesystem::path& path,
                const std::string& description);

/// A TIFF's picture and its ImageDescription.
struct TiffPicture {
  Image image;
  std::string description;
};

/// Reads the first picture of a TIFF: one channel of float32 or float64.
///
/// @throws Error  BadFile if it is damaged, or holds anything else
TiffPicture read_tiff(const std::filesystem::path& path);

}  // namespace nacre

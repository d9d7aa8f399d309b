#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/image.h"

namespace nacre {

/// A displayed picture as the bytes of a PNG file.
///
/// @param bits    8 (samples are rounded from 16) or 16 a channel
/// @throws Error  BadArgument for other depths
std::string encode_png(const DisplayImage& picture, int bits = 8);

/// Writes a displayed picture as PNG, under its name only when whole.
///
/// @param bits    8 (samples are rounded from 16) or 16 a channel
/// @throws Error  BadArgument for other depths, or a name that cannot be written to
void write_png(const DisplayImage& picture, const std::filesystem::path& path, int bits = 8);

/// Reads a PNG of 1 to 16 bits; palettes become RGB, transparency is dropped.
///
/// @throws Error  BadFile if it is damaged or larger than 32768 pixels a side
DisplayImage read_png(const std::filesystem::path& path);

}  // namespace nacre

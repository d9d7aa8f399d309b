#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/byte_source.h"

namespace nacre {

/// The two chunks of a binary glTF file.
struct GlbContainer {
  std::string json;
  std::uint64_t binary_offset = 0;  ///< in the file
  std::size_t binary_size = 0;      ///< 0 if there is no such chunk
};

/// Finds a file's chunks and reads the JSON one.
/// @param name  the path, for messages
/// @throws Error  BadFile unless every length fits the file
GlbContainer read_glb_container(const ByteSource& source, std::string_view name);

}  // namespace nacre

#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "io/draco_guard.h"
#include "io/shell_reader.h"

namespace nacre {

/// Where a shell's compressed data lies, and what it must be.
struct ShellPayload {
  std::size_t offset = 0;  ///< in the binary chunk
  std::size_t size = 0;
  std::uint64_t checksum = 0;
  DracoCounts counts;
  glm::dvec3 lo{0.0};  ///< bounds of the positions, as the file states them
  glm::dvec3 hi{0.0};
};

/// A shell file's JSON, understood and checked.
struct ShellDirectory {
  ShellFileInfo info;                                 ///< all but `file_bytes`
  std::vector<std::optional<ShellPayload>> payloads;  ///< one a level; none if it is empty
  std::vector<std::optional<ShellPayload>> coarse;    ///< of coarse copies, likewise
};

/// Understands a shell file's JSON.
///
/// @param binary_size  bytes of the file's binary chunk
/// @param name         the path, for messages
/// @throws Error  BadFile if the JSON is not that of a shell file, or points outside the binary
///                chunk; Unsupported if it is of a later format
ShellDirectory parse_shell_directory(std::string_view json, std::size_t binary_size,
                                     std::string_view name);

}  // namespace nacre

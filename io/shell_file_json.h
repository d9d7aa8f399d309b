#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include "core/shell_set.h"
#include "io/draco_guard.h"

namespace nacre {

/// A compressed shell in the binary chunk.
struct StoredShell {
  std::size_t offset = 0;  ///< of its bytes in the chunk
  std::size_t size = 0;
  std::uint64_t checksum = 0;  ///< xxh64 of its bytes
  DracoCounts counts;
  glm::vec3 lo{0.0f};  ///< bounds of its positions
  glm::vec3 hi{0.0f};
};

/// The JSON chunk of a shell file (docs/shell_file.md).
///
/// @param stored            one a shell; none for an empty level
/// @param binary_size       bytes of the binary chunk
/// @param certificate_json  a JSON value, or empty
/// @throws Error  BadArgument if the certificate is not JSON
std::string shell_file_json(const ShellSet& set, std::span<const std::optional<StoredShell>> stored,
                            std::size_t binary_size, const std::string& certificate_json);

}  // namespace nacre

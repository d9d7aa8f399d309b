#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

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

/// Coarse copies in the binary chunk, see `CoarseShells`.
struct StoredCoarse {
  std::vector<std::optional<StoredShell>> shells;  ///< one a level; none: there are no copies
  double tolerance = 0.0;
  std::string max_error_json = {};
  std::string max_fine_error_json = {};
  std::string sum_error_json = {};
};

/// What the binary chunk holds.
struct StoredSet {
  std::vector<std::optional<StoredShell>> shells;  ///< one a level; none for an empty one
  StoredCoarse coarse = {};
  std::size_t binary_size = 0;  ///< bytes of the chunk
};

/// The JSON chunk of a shell file (docs/shell_file.md).
///
/// @param certificate_json  a JSON value, or empty
/// @throws Error  BadArgument if the certificate or the error of coarse copies is not JSON
std::string shell_file_json(const ShellSet& set, const StoredSet& stored,
                            const std::string& certificate_json);

}  // namespace nacre

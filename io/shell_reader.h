#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "core/shell_set.h"

namespace nacre {

/// What a shell file says of one level without decoding it.
struct ShellFileLevel {
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  std::size_t bytes = 0;  ///< compressed; 0 for an empty level
  glm::dvec3 lo_mm{0.0};  ///< bounds of the positions, relative to the set's centre
  glm::dvec3 hi_mm{0.0};
};

/// What a shell file says of its coarse copies (`CoarseShells`).
struct ShellFileCoarse {
  double tolerance = 0.0;           ///< emission error that their simplification was allowed
  std::string max_error_json;       ///< of their maxima; empty if the file does not state it
  std::string max_fine_error_json;  ///< of maxima estimated between the levels, likewise
  std::string sum_error_json;       ///< of their sums, likewise
  std::vector<std::optional<ShellFileLevel>> levels;  ///< one a shell; none: it has no copy
};

/// What a shell file holds, without its surfaces.
struct ShellFileInfo {
  ShellSet set;                        ///< every surface empty
  std::vector<ShellFileLevel> levels;  ///< one a shell
  int format_version = 0;
  std::string generator;         ///< the program that wrote the file
  std::string certificate_json;  ///< empty if the file has none
  std::optional<ShellFileCoarse> coarse;
  std::size_t file_bytes = 0;
};

struct ShellReadOptions {
  /// Whether to decode a shell; shells that are not wanted have an empty surface. Empty: all.
  std::function<bool(std::size_t shell)> wanted = {};
  /// Whether to decode coarse copies in place of the shells that have one.
  bool coarse = false;
  ProgressCallback progress = {};
};

/// Reads what a shell file says of itself; decodes nothing, and reads no more than its JSON.
/// @throws Error  BadFile: "PATH: found ..., expected ..."
ShellFileInfo read_shell_file_info(const std::filesystem::path& path);

/// Reads a shell set, decoding wanted shells in parallel.
///
/// Trusts nothing: every length, offset and count is checked against the file before anything is
/// allocated for it, the compressed data is checked against its checksum and its structure before
/// it is decoded, and positions and indices after that.
///
/// @throws Error  BadFile: "PATH: found ..., expected ..."
ShellSet read_shell_set(const std::filesystem::path& path, const ShellReadOptions& options = {});

/// The same from memory; `name` stands for the path in messages.
ShellFileInfo parse_shell_file_info(std::span<const std::byte> file, std::string_view name);
ShellSet decode_shell_set(std::span<const std::byte> file, std::string_view name,
                          const ShellReadOptions& options = {});

}  // namespace nacre

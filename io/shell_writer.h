#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/shell_set.h"

namespace nacre {

struct ShellWriteOptions {
  /// Any JSON value, written as `certificate`; empty writes none.
  std::string certificate_json = {};
  /// Draco's effort: 0 is fastest, 10 smallest.
  int compression = 10;
  ProgressCallback progress = {};
};

/// A shell set as the bytes of a `.glb` file: binary glTF 2.0 that any viewer opens, one
/// Draco-compressed mesh a shell, the shells' meaning in `extras.nacre` (docs/shell_file.md).
///
/// What decodes is what is given, bit for bit: positions must lie on the set's grid already
/// (`snap`). Shells are compressed in parallel; the bytes do not depend on the number of threads.
///
/// @param set  shells closed and free of degenerate triangles (Draco drops those), levels strictly
///             ascending; an empty surface is written as a level without a mesh
/// @throws Error  BadArgument if the set has no exact grid, a position is not on it, an index is
///                out of range, a number is not finite, levels do not ascend, or the certificate
///                is not JSON; Unsupported if the file would exceed the 4 GiB of binary glTF
std::vector<std::byte> encode_shell_set(const ShellSet& set, const ShellWriteOptions& options = {});

/// The same, freeing each surface as soon as it is compressed: a large set need not stand in memory
/// twice.
std::vector<std::byte> encode_shell_set(ShellSet&& set, const ShellWriteOptions& options = {});

/// Writes `encode_shell_set` to a file, which appears whole or not at all.
/// @throws Error  as above, and as `AtomicFile` if it cannot be written
void write_shell_set(const std::filesystem::path& path, const ShellSet& set,
                     const ShellWriteOptions& options = {});

}  // namespace nacre

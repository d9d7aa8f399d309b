#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/shell_set.h"

namespace nacre {

/// One shell compressed, as it lies in the file.
struct CompressedShell {
  std::vector<std::byte> bytes;  ///< none for an empty surface
  std::uint64_t checksum = 0;    ///< xxh64 of the bytes
  std::size_t triangles = 0;     ///< that decode
  std::size_t vertices = 0;
  glm::vec3 lo{0.0f};  ///< bounds of the positions
  glm::vec3 hi{0.0f};
};

/// Coarser copies of a set's shells, which the file holds beside them.
struct CoarseShells {
  double tolerance = 0.0;  ///< emission error that their simplification was allowed
  std::vector<CompressedShell> shells = {};  ///< one a level; without bytes where there is no copy
  /// Any JSON values that state the error of their maxima, of maxima estimated between the levels,
  /// and of their sums, written as `coarse.max`, `coarse.max_fine` and `coarse.sum`; empty: none.
  std::string max_error_json = {};
  std::string max_fine_error_json = {};
  std::string sum_error_json = {};
};

/// Draco's effort: 0 is fastest, 10 smallest.
inline constexpr int kMostEffort = 10;

/// The effort for surfaces that may be simplified, which are to be small, or are not, which are to
/// be had soon: those come 4 % larger, in half of the time, and load a quarter faster
/// (docs/decisions/026-effort-of-compression.md).
constexpr int effort_for(bool is_simplified) { return is_simplified ? kMostEffort : 8; }

struct ShellWriteOptions {
  /// Any JSON value, written as `certificate`; empty writes none.
  std::string certificate_json = {};
  int compression = kMostEffort;  ///< Draco's effort
  /// On the set's own grid; none: the file has no coarse copies.
  std::optional<CoarseShells> coarse = {};
  ProgressCallback progress = {};
};

/// Compresses one surface of a set, which is gone as soon as its last copy is needed no more.
///
/// @param compression  see `ShellWriteOptions`
/// @throws Error       BadArgument if the grid is not exact, a position not on it, or an index out
///                     of range
CompressedShell compress_shell(TriangleMesh&& surface, const QuantizationGrid& grid,
                               int compression = kMostEffort);

/// The same as fast as it can be had, for a page on the same machine: Draco's sequential method,
/// six times the bytes. Viewers decode it; `read_shell_set` refuses it, since its indices are
/// unchecked.
/// @throws Error  as `compress_shell`
CompressedShell pack_shell(TriangleMesh&& surface, const QuantizationGrid& grid);

/// The bytes of a set whose surfaces were compressed one by one.
///
/// @param set     its surfaces are not looked at
/// @param shells  one for each of its levels
/// @throws Error  as `encode_shell_set`; BadArgument if there are not as many coarse copies
std::vector<std::byte> assemble_shell_set(const ShellSet& set,
                                          std::span<const CompressedShell> shells,
                                          const ShellWriteOptions& options = {});

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
///                or the error of coarse copies is not JSON; Unsupported if the file would exceed
///                the 4 GiB of binary glTF
std::vector<std::byte> encode_shell_set(const ShellSet& set, const ShellWriteOptions& options = {});

/// Writes `encode_shell_set` to a file, which appears whole or not at all.
/// @throws Error  as above, and as `AtomicFile` if it cannot be written
void write_shell_set(const std::filesystem::path& path, const ShellSet& set,
                     const ShellWriteOptions& options = {});

}  // namespace nacre

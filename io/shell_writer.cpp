#include "io/shell_writer.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <optional>
#include <utility>

#include "core/checksum.h"
#include "core/error.h"
#include "core/quantization_grid.h"
#include "io/atomic_file.h"
#include "io/draco_encode.h"
#include "io/shell_file_format.h"
#include "io/shell_file_json.h"
#include "io/shell_set_rules.h"

namespace nacre {
namespace {

constexpr std::size_t kAlignment = 4;

std::size_t aligned(std::size_t size) { return (size + kAlignment - 1) / kAlignment * kAlignment; }

void check_surface(const TriangleMesh& surface, const QuantizationGrid& grid) {
  if (!is_exact(grid)) {
    throw Error(ErrorCode::BadArgument,
                "shell: found a grid whose points are not floats, expected an exact one");
  }
  for (const glm::vec3& p : surface.positions) {
    if (!is_on(grid, p)) {
      throw Error(
          ErrorCode::BadArgument,
          fmt::format("shell: found a vertex at ({}, {}, {}), expected it on the set's grid", p.x,
                      p.y, p.z));
    }
  }
  for (const glm::uvec3& t : surface.triangles) {
    if (std::max({t.x, t.y, t.z}) >= surface.positions.size()) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("shell: found triangle ({}, {}, {}), expected indices below {}", t.x,
                              t.y, t.z, surface.positions.size()));
    }
  }
}

/// Bounds over the vertices that triangles use, which are those that decode.
void set_bounds(const TriangleMesh& surface, CompressedShell& shell) {
  shell.lo = glm::vec3(std::numeric_limits<float>::max());
  shell.hi = glm::vec3(std::numeric_limits<float>::lowest());
  for (const glm::uvec3& t : surface.triangles) {
    for (int i = 0; i < 3; ++i) {
      shell.lo = glm::min(shell.lo, surface.positions[t[i]]);
      shell.hi = glm::max(shell.hi, surface.positions[t[i]]);
    }
  }
}

/// Grows a file by parts; binary glTF is little-endian, as the machines this runs on are.
class ByteWriter {
 public:
  explicit ByteWriter(std::size_t size) { bytes_.reserve(size); }

  void number(std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    append(&word, sizeof(word));
  }
  void append(const void* data, std::size_t size) {
    const auto* begin = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }
  void pad(char filler) { bytes_.resize(aligned(bytes_.size()), static_cast<std::byte>(filler)); }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// @param parts  what the binary chunk holds, in order
std::vector<std::byte> glb(const std::string& json,
                           std::initializer_list<std::span<const CompressedShell>> parts,
                           std::size_t binary_size) {
  using namespace shell_file;
  const std::size_t json_size = aligned(json.size());
  std::size_t size = kGlbHeaderSize + kChunkHeaderSize + json_size;
  if (binary_size > 0) size += kChunkHeaderSize + binary_size;
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("shell set: found {} bytes, expected less than the 4 GiB of binary "
                            "glTF",
                            size));
  }
  ByteWriter out(size);
  for (const std::size_t word : {std::size_t{kGlbMagic}, std::size_t{kGlbVersion}, size, json_size,
                                 std::size_t{kJsonChunk}}) {
    out.number(word);
  }
  out.append(json.data(), json.size());
  out.pad(' ');
  if (binary_size > 0) {
    out.number(binary_size);
    out.number(kBinaryChunk);
    for (const std::span<const CompressedShell> shells : parts) {
      for (const CompressedShell& shell : shells) {
        out.append(shell.bytes.data(), shell.bytes.size());
        out.pad('\0');
      }
    }
  }
  return out.take();
}

void check_set(const ShellSet& set) {
  if (const auto objection = shell_set_objection(set)) {
    throw Error(ErrorCode::BadArgument, "shell set: " + *objection);
  }
}

/// Gives shells their places in the binary chunk, from its present end.
std::vector<std::optional<StoredShell>> store(std::span<const CompressedShell> shells,
                                              std::size_t& binary_size) {
  std::vector<std::optional<StoredShell>> stored;
  for (const CompressedShell& shell : shells) {
    stored.emplace_back();
    if (shell.bytes.empty()) continue;
    stored.back() = {.offset = binary_size,
                     .size = shell.bytes.size(),
                     .checksum = shell.checksum,
                     .counts = {shell.triangles, shell.vertices},
                     .lo = shell.lo,
                     .hi = shell.hi};
    binary_size += aligned(shell.bytes.size());
  }
  return stored;
}

void check_coarse(const CoarseShells& coarse, std::span<const CompressedShell> shells) {
  const bool is_tolerance = coarse.tolerance >= 0.0 && std::isfinite(coarse.tolerance);
  if (!is_tolerance) {
    throw Error(
        ErrorCode::BadArgument,
        fmt::format("coarse copies: found tolerance {}, expected 0 or more", coarse.tolerance));
  }
  if (coarse.shells.size() != shells.size()) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("coarse copies: found {}, expected {}, one a level",
                            coarse.shells.size(), shells.size()));
  }
  for (std::size_t k = 0; k < shells.size(); ++k) {
    if (coarse.shells[k].bytes.empty() || !shells[k].bytes.empty()) continue;
    throw Error(
        ErrorCode::BadArgument,
        fmt::format("coarse copies: found one of level {}, expected none of an empty shell", k));
  }
}

CompressedShell encode(TriangleMesh&& surface, const QuantizationGrid& grid, int compression,
                       DracoMethod method) {
  CompressedShell shell;
  check_surface(surface, grid);
  if (surface.triangles.empty()) return shell;
  set_bounds(surface, shell);
  DracoData data = encode_draco(std::move(surface), grid, compression, method);
  shell.bytes = std::move(data.bytes);
  shell.checksum = xxh64(shell.bytes);
  shell.triangles = data.counts.triangles;
  shell.vertices = data.counts.vertices;
  return shell;
}

}  // namespace

CompressedShell compress_shell(TriangleMesh&& surface, const QuantizationGrid& grid,
                               int compression) {
  return encode(std::move(surface), grid, compression, DracoMethod::Edgebreaker);
}

CompressedShell pack_shell(TriangleMesh&& surface, const QuantizationGrid& grid) {
  return encode(std::move(surface), grid, 0, DracoMethod::Sequential);
}

std::vector<std::byte> assemble_shell_set(const ShellSet& set,
                                          std::span<const CompressedShell> shells,
                                          const ShellWriteOptions& options) {
  check_set(set);
  std::size_t binary_size = 0;
  StoredSet stored{.shells = store(shells, binary_size)};
  std::span<const CompressedShell> copies;
  if (options.coarse) {
    check_coarse(*options.coarse, shells);
    copies = options.coarse->shells;
    stored.coarse = {store(copies, binary_size), options.coarse->tolerance,
                     options.coarse->max_error_json, options.coarse->max_fine_error_json,
                     options.coarse->sum_error_json};
  }
  stored.binary_size = binary_size;
  return glb(shell_file_json(set, stored, options.certificate_json), {shells, copies}, binary_size);
}

std::vector<std::byte> encode_shell_set(const ShellSet& set, const ShellWriteOptions& options) {
  check_set(set);
  std::vector<CompressedShell> shells(set.shells.size());
  ProgressMeter progress(options.progress, "encode", set.shells.size());
  tbb::parallel_for(std::size_t{0}, set.shells.size(), [&](std::size_t k) {
    TriangleMesh copy = set.shells[k].surface;
    shells[k] = compress_shell(std::move(copy), *set.grid, options.compression);
    progress.advance();
  });
  return assemble_shell_set(set, shells, options);
}

void write_shell_set(const std::filesystem::path& path, const ShellSet& set,
                     const ShellWriteOptions& options) {
  const std::vector<std::byte> bytes = encode_shell_set(set, options);
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace nacre

#include "io/shell_writer.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>

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

void check_surface(const Shell& shell, std::size_t k, const QuantizationGrid& grid) {
  for (const glm::vec3& p : shell.surface.positions) {
    if (!is_on(grid, p)) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("shell {}: found a vertex at ({}, {}, {}), expected it on the set's "
                              "grid",
                              k, p.x, p.y, p.z));
    }
  }
  for (const glm::uvec3& t : shell.surface.triangles) {
    if (std::max({t.x, t.y, t.z}) >= shell.surface.positions.size()) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("shell {}: found triangle ({}, {}, {}), expected indices below {}", k,
                              t.x, t.y, t.z, shell.surface.positions.size()));
    }
  }
}

/// A shell's place in the file, all but its offset. Bounds over the vertices that triangles use,
/// which are those that decode.
StoredShell describe(const TriangleMesh& surface, const DracoData& data) {
  StoredShell stored;
  stored.size = data.bytes.size();
  stored.checksum = xxh64(data.bytes);
  stored.counts = data.counts;
  stored.lo = glm::vec3(std::numeric_limits<float>::max());
  stored.hi = glm::vec3(std::numeric_limits<float>::lowest());
  for (const glm::uvec3& t : surface.triangles) {
    for (int i = 0; i < 3; ++i) {
      stored.lo = glm::min(stored.lo, surface.positions[t[i]]);
      stored.hi = glm::max(stored.hi, surface.positions[t[i]]);
    }
  }
  return stored;
}

/// A shell's compressed bytes and its place in the file; no place where it is empty.
struct CompressedShell {
  DracoData data;
  std::optional<StoredShell> stored;
};

/// @param done  called with each shell once its surface is not needed any more
std::vector<CompressedShell> compress(const ShellSet& set, const ShellWriteOptions& options,
                                      const std::function<void(std::size_t)>& done) {
  std::vector<CompressedShell> shells(set.shells.size());
  ProgressMeter progress(options.progress, "encode", set.shells.size());
  tbb::parallel_for(std::size_t{0}, set.shells.size(), [&](std::size_t k) {
    const Shell& shell = set.shells[k];
    check_surface(shell, k, *set.grid);
    if (!shell.surface.triangles.empty()) {
      shells[k].data = encode_draco(shell.surface, *set.grid, options.compression);
      shells[k].stored = describe(shell.surface, shells[k].data);
    }
    done(k);
    progress.advance();
  });
  return shells;
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

std::vector<std::byte> glb(const std::string& json, const std::vector<CompressedShell>& shells,
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
    for (const CompressedShell& shell : shells) {
      out.append(shell.data.bytes.data(), shell.data.bytes.size());
      out.pad('\0');
    }
  }
  return out.take();
}

std::vector<std::byte> encode(const ShellSet& set, const ShellWriteOptions& options,
                              const std::function<void(std::size_t)>& done) {
  if (const auto objection = shell_set_objection(set)) {
    throw Error(ErrorCode::BadArgument, "shell set: " + *objection);
  }
  const std::vector<CompressedShell> shells = compress(set, options, done);
  std::vector<std::optional<StoredShell>> stored;
  std::size_t binary_size = 0;
  for (const CompressedShell& shell : shells) {
    stored.push_back(shell.stored);
    if (!shell.stored) continue;
    stored.back()->offset = binary_size;
    binary_size += aligned(shell.stored->size);
  }
  return glb(shell_file_json(set, stored, binary_size, options.certificate_json), shells,
             binary_size);
}

}  // namespace

std::vector<std::byte> encode_shell_set(const ShellSet& set, const ShellWriteOptions& options) {
  return encode(set, options, [](std::size_t) {});
}

std::vector<std::byte> encode_shell_set(ShellSet&& set, const ShellWriteOptions& options) {
  return encode(set, options, [&](std::size_t k) { set.shells[k].surface = {}; });
}

void write_shell_set(const std::filesystem::path& path, const ShellSet& set,
                     const ShellWriteOptions& options) {
  const std::vector<std::byte> bytes = encode_shell_set(set, options);
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace nacre

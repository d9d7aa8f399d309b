#include "io/shell_reader.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include "core/checksum.h"
#include "core/error.h"
#include "io/byte_source.h"
#include "io/draco_decode.h"
#include "io/glb_container.h"
#include "io/shell_directory.h"

namespace nacre {
namespace {

struct OpenedShellFile {
  ShellDirectory directory;
  std::uint64_t binary_offset = 0;
};

OpenedShellFile open(const ByteSource& source, std::string_view name) {
  const GlbContainer container = read_glb_container(source, name);
  OpenedShellFile file{parse_shell_directory(container.json, container.binary_size, name),
                       container.binary_offset};
  file.directory.info.file_bytes = source.size();
  return file;
}

/// Renderers leave out what lies outside the view by these bounds, before anything is decoded.
void check_bounds(const TriangleMesh& mesh, const ShellPayload& payload) {
  for (const glm::vec3& position : mesh.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      const double p = position[axis];
      if (p >= payload.lo[axis] && p <= payload.hi[axis]) continue;
      throw Error(ErrorCode::BadFile, fmt::format("found a position at {} mm, expected it within "
                                                  "the stated bounds {} to {}",
                                                  p, payload.lo[axis], payload.hi[axis]));
    }
  }
}

TriangleMesh decode(const ByteSource& source, std::uint64_t binary_offset,
                    const ShellPayload& payload) {
  const std::vector<std::byte> data = source.read(binary_offset + payload.offset, payload.size);
  if (const std::uint64_t found = xxh64(data); found != payload.checksum) {
    throw Error(ErrorCode::BadFile,
                fmt::format("found checksum {}, expected {} (the file is damaged)",
                            checksum_text(found), checksum_text(payload.checksum)));
  }
  TriangleMesh mesh = decode_draco(data, payload.counts);
  check_bounds(mesh, payload);
  return mesh;
}

std::vector<std::size_t> wanted_shells(const ShellDirectory& directory,
                                       const ShellReadOptions& options) {
  std::vector<std::size_t> wanted;
  for (std::size_t k = 0; k < directory.payloads.size(); ++k) {
    if (directory.payloads[k] && (!options.wanted || options.wanted(k))) wanted.push_back(k);
  }
  return wanted;
}

/// What to decode of a shell: its coarse copy where that is asked for and there is one.
const ShellPayload& payload_to_decode(const ShellDirectory& directory, std::size_t k,
                                      const ShellReadOptions& options) {
  const bool is_coarse = options.coarse && directory.coarse[k].has_value();
  return is_coarse ? *directory.coarse[k] : *directory.payloads[k];
}

ShellSet read(const ByteSource& source, std::string_view name, const ShellReadOptions& options) {
  OpenedShellFile file = open(source, name);
  ShellSet set = std::move(file.directory.info.set);
  const std::vector<std::size_t> wanted = wanted_shells(file.directory, options);
  ProgressMeter progress(options.progress, "decode", wanted.size());
  tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t i) {
    const std::size_t k = wanted[i];
    try {
      set.shells[k].surface =
          decode(source, file.binary_offset, payload_to_decode(file.directory, k, options));
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("{}: shell {}: {}", name, k + 1, error.what()));
    }
    progress.advance();
  });
  return set;
}

}  // namespace

ShellFileInfo read_shell_file_info(const std::filesystem::path& path) {
  return open(FileSource(path), path.string()).directory.info;
}

ShellSet read_shell_set(const std::filesystem::path& path, const ShellReadOptions& options) {
  return read(FileSource(path), path.string(), options);
}

ShellFileInfo parse_shell_file_info(std::span<const std::byte> file, std::string_view name) {
  return open(MemorySource(file), name).directory.info;
}

ShellSet decode_shell_set(std::span<const std::byte> file, std::string_view name,
                          const ShellReadOptions& options) {
  return read(MemorySource(file), name, options);
}

}  // namespace nacre

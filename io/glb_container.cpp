#include "io/glb_container.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "io/shell_file_format.h"

namespace nacre {
namespace {

using namespace shell_file;

[[noreturn]] void reject(std::string_view name, const std::string& what) {
  throw Error(ErrorCode::BadFile, fmt::format("{}: {}", name, what));
}

std::uint32_t word(const std::vector<std::byte>& bytes, std::size_t index) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + sizeof(value) * index, sizeof(value));
  return value;
}

struct ChunkHeader {
  std::uint64_t offset;  ///< of its data
  std::uint32_t size;
  std::uint32_t type;
};

ChunkHeader read_chunk_header(const ByteSource& source, std::uint64_t offset,
                              std::string_view name) {
  if (source.size() - offset < kChunkHeaderSize) {
    reject(name, fmt::format("found {} bytes after byte {}, expected a chunk's header",
                             source.size() - offset, offset));
  }
  const std::vector<std::byte> header = source.read(offset, kChunkHeaderSize);
  const ChunkHeader chunk{offset + kChunkHeaderSize, word(header, 0), word(header, 1)};
  if (chunk.size > source.size() - chunk.offset) {
    reject(name, fmt::format("found a chunk of {} bytes at byte {}, expected at most the {} that "
                             "follow",
                             chunk.size, chunk.offset, source.size() - chunk.offset));
  }
  return chunk;
}

void check_file_header(const ByteSource& source, std::string_view name) {
  if (source.size() < kGlbHeaderSize) {
    reject(name, fmt::format("found {} bytes, expected a binary glTF file", source.size()));
  }
  const std::vector<std::byte> header = source.read(0, kGlbHeaderSize);
  if (word(header, 0) != kGlbMagic) {
    reject(name, "found no glTF mark, expected a binary glTF file (.glb)");
  }
  if (word(header, 1) != kGlbVersion) {
    reject(name, fmt::format("found binary glTF version {}, expected 2", word(header, 1)));
  }
  if (word(header, 2) != source.size()) {
    reject(name, fmt::format("found {} bytes, expected {} as the header says (cut short or added "
                             "to)",
                             source.size(), word(header, 2)));
  }
}

}  // namespace

GlbContainer read_glb_container(const ByteSource& source, std::string_view name) {
  check_file_header(source, name);
  const ChunkHeader json = read_chunk_header(source, kGlbHeaderSize, name);
  if (json.type != kJsonChunk) reject(name, "found another first chunk, expected JSON");
  if (json.size > kMaxJsonSize) {
    reject(name,
           fmt::format("found {} bytes of JSON, expected at most {}", json.size, kMaxJsonSize));
  }
  GlbContainer container;
  const std::vector<std::byte> text = source.read(json.offset, json.size);
  container.json.assign(reinterpret_cast<const char*>(text.data()), text.size());
  const std::uint64_t next = json.offset + json.size;
  if (next == source.size()) return container;
  const ChunkHeader binary = read_chunk_header(source, next, name);
  // Chunks of other types are to be ignored, says glTF; the binary one comes second if at all.
  if (binary.type != kBinaryChunk) return container;
  container.binary_offset = binary.offset;
  container.binary_size = binary.size;
  return container;
}

}  // namespace nacre

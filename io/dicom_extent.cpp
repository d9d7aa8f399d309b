#include "io/dicom_extent.h"

#include <array>
#include <fstream>

#include "io/stretch.h"

namespace nacre {
namespace {

std::uint32_t little_endian(const unsigned char* bytes) {
  return bytes[0] | (std::uint32_t{bytes[1]} << 8) | (std::uint32_t{bytes[2]} << 16) |
         (std::uint32_t{bytes[3]} << 24);
}

/// Follows items, each with its length, to the sequence's delimiter.
bool ends_with_delimiter(const std::filesystem::path& path, std::uint64_t offset) {
  constexpr std::uint32_t item = 0xe000fffe;
  constexpr std::uint32_t delimiter = 0xe0ddfffe;
  const std::uint64_t size = file_size_of(path);
  std::ifstream file(path, std::ios::binary);
  std::array<char, 8> bytes{};
  while (offset < size) {
    file.seekg(static_cast<std::streamoff>(offset));
    if (!file.read(bytes.data(), bytes.size())) return false;
    std::array<unsigned char, 8> head{};
    for (std::size_t i = 0; i < head.size(); ++i) head[i] = static_cast<unsigned char>(bytes[i]);
    const std::uint32_t tag = little_endian(head.data());
    if (tag == delimiter) return true;
    if (tag != item) return false;
    offset += head.size() + little_endian(head.data() + 4);
  }
  return false;
}

}  // namespace

bool holds_samples(const std::filesystem::path& path, const DicomExtent& extent,
                   std::uint64_t size) {
  if (extent.deflated) return true;
  if (extent.encapsulated) return ends_with_delimiter(path, extent.offset);
  const std::uint64_t file_size = file_size_of(path);
  return extent.offset <= file_size && size <= file_size - extent.offset;
}

}  // namespace nacre

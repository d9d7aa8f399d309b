#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace nacre {

/// How bytes lie in a file.
enum class Packing : std::uint8_t {
  Raw,
  Deflated,  ///< gzip (one or more members) or zlib
};

/// Where a file holds some bytes: from an offset on, perhaps packed.
struct Stretch {
  std::filesystem::path path;
  std::uint64_t offset = 0;  ///< of the first (packed) byte in the file
  Packing packing = Packing::Raw;
  std::uint64_t skip = 0;  ///< bytes to pass over at the start of the unpacked stream
};

/// Size of an existing regular file.
/// @throws Error  BadFile if there is none
std::uint64_t file_size_of(const std::filesystem::path& path);

/// Deflated if the file begins with gzip's magic number, else Raw.
/// @throws Error  BadFile if the file cannot be read
Packing packing_of(const std::filesystem::path& path);

/// Refuses a stretch that cannot hold `size` bytes, before anything is allocated for them: raw
/// bytes must all be in the file, deflated ones cannot grow more than 1032-fold (the format's
/// limit).
/// @throws Error  BadFile
void check_stretch_holds(const Stretch& stretch, std::uint64_t size);

/// Reads a stretch from its start to its end, in little memory beside the caller's buffer.
class StretchReader {
 public:
  /// @throws Error  BadFile if the file cannot be read, or ends within `stretch.skip`
  explicit StretchReader(const Stretch& stretch);
  ~StretchReader();
  StretchReader(const StretchReader&) = delete;
  StretchReader& operator=(const StretchReader&) = delete;

  /// Fills `bytes` as far as the stretch lasts; returns how many were there.
  /// @throws Error  BadFile where packed bytes are damaged
  std::size_t read_some(std::span<std::byte> bytes);

  /// True if no byte is left. Of a packed stretch read to its end this has verified the checksum.
  bool at_end();

 private:
  class Source;
  std::unique_ptr<Source> source_;
};

}  // namespace nacre

#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "core/volume.h"
#include "io/stretch.h"
#include "io/volume_read_report.h"

namespace nacre {

/// The types of samples found in files: those of a Volume, and the two that become 32 bits wide.
enum class StoredType : std::uint8_t { U8, I8, U16, I16, U32, I32, F32, F64, I64, U64 };

/// Bytes of one sample.
std::size_t size_of(StoredType type) noexcept;

/// The integer type of `size` bytes (1, 2, 4 or 8).
StoredType integer_type(std::size_t size, bool is_signed) noexcept;

/// How a volume's samples lie in files, x fastest.
struct StoredSamples {
  glm::i64vec3 dims{0};
  StoredType type = StoredType::U8;
  bool big_endian = false;
  /// One after the other, each the same share of the samples. Not empty.
  std::vector<Stretch> pieces;
  /// The samples are the last bytes of each (raw) file, whatever comes before them.
  bool at_file_end = false;
};

/// Reads samples into a volume (identity geometry) in their stored type and the machine's byte
/// order. 64-bit integers become i32 or u32 if all of them fit. Peak memory: the volume and less
/// than a megabyte.
///
/// @param path    named in messages about the volume as a whole
/// @throws Error  BadFile if dimensions are out of range, the files are too short (checked before
///                allocating), damaged, or hold integers of more than 32 bits
Volume read_stored_samples(const std::filesystem::path& path, const StoredSamples& stored,
                           VolumeReadReport& report);

/// Reverses the bytes of each `size`-byte word of a buffer.
void swap_bytes(std::span<std::byte> bytes, std::size_t size);

}  // namespace nacre

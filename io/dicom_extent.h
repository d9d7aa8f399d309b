#pragma once

#include <cstdint>
#include <filesystem>

namespace nacre {

/// Where the samples of a DICOM file begin, and how they lie from there on.
struct DicomExtent {
  std::uint64_t offset = 0;   ///< of the first byte of the pixel data's value
  bool encapsulated = false;  ///< compressed, in items up to a delimiter
  bool deflated = false;      ///< the whole file is; its offsets mean nothing
};

/// True if the file is long enough for its samples: `size` bytes as they are, or all items and
/// their delimiter. GDCM decodes cut files without a word, as far as they go.
bool holds_samples(const std::filesystem::path& path, const DicomExtent& extent,
                   std::uint64_t size);

}  // namespace nacre

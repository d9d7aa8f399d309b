#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace nacre {

/// Where the samples of a MetaImage lie, and what must be known before its library may parse it.
struct MetaImageText {
  bool local = true;                              ///< samples follow the header in the same file
  std::uint64_t end = 0;                          ///< offset of the byte after the header
  std::vector<std::filesystem::path> data_files;  ///< the file itself if local
};

/// Scans a MetaImage header to its last field, ElementDataFile.
///
/// The library that parses the fields trusts them: it counts up to any NDims and fills arrays of
/// fixed size. So numbers are checked here first.
///
/// @throws Error  BadFile if a field is out of range or the header has no end
MetaImageText read_metaimage_text(const std::filesystem::path& path);

}  // namespace nacre

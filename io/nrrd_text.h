#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace nacre {

/// The text of an NRRD header, apart from where the samples lie.
struct NrrdText {
  std::string fields;  ///< magic line and fields, without "data file"
  bool attached = true;
  std::uint64_t end = 0;                          ///< offset of the byte after the header
  std::vector<std::filesystem::path> data_files;  ///< the file itself if attached
};

/// Splits an NRRD header.
///
/// The names of data files are taken out because the library that reads the fields would print a
/// pattern from the file with sprintf, and open what it names before anything is checked.
///
/// @throws Error  BadFile if this is no NRRD file or the header has no end
NrrdText read_nrrd_text(const std::filesystem::path& path);

}  // namespace nacre

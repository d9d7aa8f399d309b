#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <string_view>
#include <vector>

namespace nacre {

/// Files that a detached header (NRRD, MetaImage) names: one; "PATTERN MIN MAX STEP" with one "%d"
/// or "%03d" in the pattern; or "LIST", and then one a line in `lines_after`. Relative names start
/// at the header's folder.
///
/// @throws Error  BadFile if no name can be made of it
std::vector<std::filesystem::path> named_data_files(const std::filesystem::path& header,
                                                    std::string_view value,
                                                    std::istream& lines_after);

/// Offset of the byte after `lines` line ends of a file, counted from the byte `begin`.
/// @throws Error  BadFile if the file has fewer lines
std::uint64_t offset_after_lines(const std::filesystem::path& path, std::uint64_t begin,
                                 std::uint64_t lines);

}  // namespace nacre

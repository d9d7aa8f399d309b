#include "io/metaimage_text.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>

#include "io/bad_file.h"
#include "io/data_files.h"
#include "io/number_list.h"
#include "io/stretch.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxLine = 480;  // the library's line buffers hold 500
constexpr int kMaxLines = 1000;
constexpr int kMaxDimensions = 10;  // as many as the library's arrays hold

/// Next line without its end, at most `kMaxLine` long.
bool read_line(const fs::path& path, std::istream& file, std::string& line) {
  line.clear();
  for (int c = file.get(); c != std::istream::traits_type::eof(); c = file.get()) {
    if (c == '\n') return true;
    line += static_cast<char>(c);
    if (line.size() > kMaxLine) {
      throw_bad_file(path, fmt::format("a header line of more than {} bytes", kMaxLine),
                     "MetaImage fields");
    }
  }
  return !line.empty();
}

bool all_are_numbers(std::string_view value) {
  std::istringstream words{std::string(value)};
  for (std::string word; words >> word;) {
    const auto number = parse_number<double>(word.starts_with('+') ? word.substr(1) : word);
    if (!number || !std::isfinite(*number)) return false;
  }
  return true;
}

void check_numbers(const fs::path& path, std::string_view key, std::string_view value) {
  constexpr std::array<std::string_view, 14> numeric{"DimSize",
                                                     "ElementSpacing",
                                                     "ElementSize",
                                                     "TransformMatrix",
                                                     "Rotation",
                                                     "Orientation",
                                                     "Offset",
                                                     "Position",
                                                     "Origin",
                                                     "HeaderSize",
                                                     "CenterOfRotation",
                                                     "ElementNumberOfChannels",
                                                     "ElementToIntensityFunctionSlope",
                                                     "ElementToIntensityFunctionOffset"};
  for (const std::string_view name : numeric) {
    if (key == name && !all_are_numbers(value)) {
      throw_bad_file(path, fmt::format("{} \"{}\"", key, printable(value)), "finite numbers");
    }
  }
  if (key == "NDims") {
    const auto count = parse_number<int>(value);
    if (!count || *count < 1 || *count > kMaxDimensions) {
      throw_bad_file(path, fmt::format("NDims \"{}\"", printable(value)), "2 or 3");
    }
  }
  if (key != "DimSize") return;
  std::istringstream words{std::string(value)};
  for (double size = 0.0; words >> size;) {
    if (size < 1.0 || size > std::numeric_limits<int>::max()) {
      throw_bad_file(path, fmt::format("DimSize \"{}\"", printable(value)),
                     "at least one sample along each axis");
    }
  }
}

bool is_local(std::string_view value) {
  return value == "LOCAL" || value == "Local" || value == "local";
}

}  // namespace

MetaImageText read_metaimage_text(const fs::path& path) {
  if (file_size_of(path) == 0) throw_bad_file(path, "an empty file", "a MetaImage header");
  std::ifstream file(path, std::ios::binary);
  std::string line;
  for (int lines = 0; lines < kMaxLines && read_line(path, file, line); ++lines) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) {
      if (trimmed(line).empty()) continue;
      throw_bad_file(path, fmt::format("\"{}\"", printable(line)), "MetaImage fields, KEY = VALUE");
    }
    const std::string_view key = trimmed(std::string_view(line).substr(0, equals));
    const std::string_view value = trimmed(std::string_view(line).substr(equals + 1));
    check_numbers(path, key, value);
    if (key != "ElementDataFile") continue;
    MetaImageText text;
    text.local = is_local(value);
    if (!text.local) {
      text.data_files = named_data_files(path, value, file);
      return text;
    }
    if (file.eof()) throw_bad_file(path, "a header without samples after it", "samples");
    text.end = static_cast<std::uint64_t>(file.tellg());
    text.data_files = {path};
    return text;
  }
  throw_bad_file(path, "a header without ElementDataFile", "MetaImage");
}

}  // namespace nacre

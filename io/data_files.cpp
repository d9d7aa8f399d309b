#include "io/data_files.h"

#include <fmt/core.h>

#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

#include "io/bad_file.h"
#include "io/number_list.h"
#include "io/stretch.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFiles = 65536;

/// A file name with a number in it, cut at "%d" or "%0Nd". Never handed to printf: it is input.
struct Pattern {
  std::string before;
  int width = 0;
  bool zeros = false;
  std::string after;
};

std::optional<Pattern> parse_pattern(std::string_view text) {
  Pattern pattern;
  const std::size_t percent = text.find('%');
  pattern.before = text.substr(0, percent);
  std::size_t at = percent + 1;
  if (at < text.size() && text[at] == '0') {
    pattern.zeros = true;
    ++at;
  }
  if (at < text.size() && text[at] >= '1' && text[at] <= '9') pattern.width = text[at++] - '0';
  if (at >= text.size() || (text[at] != 'd' && text[at] != 'i' && text[at] != 'u')) {
    return std::nullopt;
  }
  pattern.after = text.substr(at + 1);
  if (pattern.after.find('%') != std::string::npos) return std::nullopt;
  return pattern;
}

std::string name_with(const Pattern& pattern, int number) {
  const std::string digits = pattern.zeros ? fmt::format("{:0{}}", number, pattern.width)
                                           : fmt::format("{:{}}", number, pattern.width);
  return pattern.before + digits + pattern.after;
}

std::vector<fs::path> numbered_files(const fs::path& header, std::string_view value) {
  std::istringstream words{std::string(value)};
  std::string name;
  int first = 1;
  int last = 0;
  int step = 1;
  words >> name >> first >> last;
  if (!words.fail() && !(words >> step)) step = 1;
  const std::optional<Pattern> pattern = parse_pattern(name);
  const bool counts = first >= 0 && last >= 0 && step > 0 && last >= first;
  const auto count = counts ? static_cast<std::size_t>((last - first) / step) + 1 : 0;
  if (!pattern || count == 0 || count > kMaxFiles) {
    throw_bad_file(header, fmt::format("data files \"{}\"", printable(value)),
                   "PATTERN MIN MAX STEP with one %d in the pattern");
  }
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < count; ++i) {
    files.push_back(header.parent_path() / name_with(*pattern, first + static_cast<int>(i) * step));
  }
  return files;
}

std::vector<fs::path> listed_files(const fs::path& header, std::istream& lines) {
  std::vector<fs::path> files;
  for (std::string line; std::getline(lines, line) && files.size() < kMaxFiles;) {
    const std::string_view name = trimmed(line);
    if (!name.empty()) files.push_back(header.parent_path() / name);
  }
  if (files.empty()) throw_bad_file(header, "an empty list of data files", "one name a line");
  return files;
}

}  // namespace

std::vector<fs::path> named_data_files(const fs::path& header, std::string_view value,
                                       std::istream& lines_after) {
  value = trimmed(value);
  if (value.empty()) throw_bad_file(header, "no name of a data file", "one");
  if (value == "LIST" || value.starts_with("LIST ")) return listed_files(header, lines_after);
  if (value.find('%') != std::string_view::npos) return numbered_files(header, value);
  return {header.parent_path() / value};
}

std::uint64_t offset_after_lines(const fs::path& path, std::uint64_t begin, std::uint64_t lines) {
  file_size_of(path);
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(begin));
  for (std::uint64_t line = 0; line < lines; ++line) {
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    if (file.eof()) {
      throw_bad_file(path, fmt::format("{} lines", line), fmt::format("{} to skip", lines));
    }
  }
  return static_cast<std::uint64_t>(file.tellg());
}

}  // namespace nacre

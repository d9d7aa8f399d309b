#include "io/nrrd_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <optional>

#include "io/bad_file.h"
#include "io/data_files.h"
#include "io/stretch.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxHeader = std::size_t{16} << 20;

/// The value of a "data file:" line (the name may be written in other ways too).
std::optional<std::string> data_file_value(const std::string& line) {
  const std::size_t colon = line.find(':');
  // "key:=value" is a comment of the user's.
  if (colon == std::string::npos || line.substr(colon, 2) == ":=") return std::nullopt;
  std::string name;
  for (const char c : line.substr(0, colon)) {
    if (c != ' ') name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (name != "datafile") return std::nullopt;
  return line.substr(colon + 1);
}

/// One line without its end; false at the end of the file. Bounded, whatever the file holds.
bool read_line(std::istream& file, std::string& line) {
  line.clear();
  for (int c = file.get(); c != std::istream::traits_type::eof(); c = file.get()) {
    if (c == '\n') {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      return true;
    }
    line += static_cast<char>(c);
    if (line.size() > kMaxHeader) return true;
  }
  return !line.empty();
}

}  // namespace

NrrdText read_nrrd_text(const fs::path& path) {
  if (file_size_of(path) == 0) throw_bad_file(path, "an empty file", "an NRRD header");
  std::ifstream file(path, std::ios::binary);
  std::string line;
  read_line(file, line);
  if (!line.starts_with("NRRD")) {
    throw_bad_file(path, fmt::format("\"{}\"", printable(line)), "NRRD0001 to NRRD0005");
  }
  NrrdText text;
  text.fields = line + '\n';
  while (read_line(file, line) && !line.empty()) {
    if (const auto value = data_file_value(line)) {
      text.attached = false;
      text.data_files = named_data_files(path, *value, file);
      continue;
    }
    text.fields += line + '\n';
    if (text.fields.size() > kMaxHeader) throw_bad_file(path, "a header without end", "NRRD");
  }
  if (!text.attached) return text;
  if (!line.empty() || file.eof()) {
    throw_bad_file(path, "a header that the file's end cuts off", "an empty line after it");
  }
  text.end = static_cast<std::uint64_t>(file.tellg());
  text.data_files = {path};
  return text;
}

}  // namespace nacre

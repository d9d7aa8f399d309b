#include "io/bad_file.h"

#include <fmt/core.h>

#include "core/error.h"

namespace nacre {

void throw_bad_file(const std::filesystem::path& path, const std::string& found,
                    const std::string& expected) {
  throw Error(ErrorCode::BadFile,
              fmt::format("{}: found {}, expected {}", path.string(), found, expected));
}

std::string printable(std::string_view text) {
  constexpr std::size_t max_length = 60;
  std::string shown(text.substr(0, max_length));
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  if (text.size() > max_length) shown += "...";
  return shown;
}

}  // namespace nacre

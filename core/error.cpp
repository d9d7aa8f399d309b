#include "core/error.h"

namespace nacre {
namespace {

/// Messages stay one line, whatever a file or a library put into them.
std::string single_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

std::string_view name(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::BadArgument: return "bad argument";
    case ErrorCode::BadFile: return "bad file";
    case ErrorCode::Unsupported: return "unsupported";
  }
  return "unknown";
}

Error::Error(ErrorCode code, const std::string& detail)
    : std::runtime_error(single_line(detail)), code_(code) {}

}  // namespace nacre

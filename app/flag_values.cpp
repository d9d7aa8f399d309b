#include "app/flag_values.h"

#include <fmt/core.h>

#include <charconv>

#include "core/error.h"

namespace nacre {
namespace {

template <class Number>
std::vector<Number> parse(std::string_view flag, const std::string& text, std::size_t count,
                          std::string_view expected) {
  std::vector<Number> numbers;
  bool good = true;
  for (const std::string& part : split(text, ',')) {
    // from_chars knows no leading plus sign.
    const char* begin = part.data() + (part.starts_with('+') ? 1 : 0);
    const char* end = part.data() + part.size();
    Number number{};
    const auto [stop, failure] = std::from_chars(begin, end, number);
    good = good && failure == std::errc{} && stop == end;
    numbers.push_back(number);
  }
  if (!good || (count > 0 && numbers.size() != count)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: found '{}', expected {}", flag, text, expected));
  }
  return numbers;
}

}  // namespace

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back().push_back(c);
    }
  }
  return parts;
}

std::vector<double> parse_numbers(std::string_view flag, const std::string& text, std::size_t count,
                                  std::string_view expected) {
  return parse<double>(flag, text, count, expected);
}

std::vector<long long> parse_integers(std::string_view flag, const std::string& text,
                                      std::size_t count, std::string_view expected) {
  return parse<long long>(flag, text, count, expected);
}

}  // namespace nacre

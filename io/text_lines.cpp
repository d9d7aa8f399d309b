#include "io/text_lines.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace nacre {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

/// std::from_chars knows no leading plus sign.
std::string_view without_plus(std::string_view word) noexcept {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

}  // namespace

bool TextLines::next() {
  if (offset_ >= text_.size()) return false;
  const std::size_t end = text_.find_first_of("\r\n", offset_);
  line_ = text_.substr(offset_, end - offset_);
  if (end == std::string_view::npos) {
    line_ = text_.substr(offset_);
    offset_ = text_.size();
  } else {
    offset_ = end + (text_.substr(end, 2) == "\r\n" ? 2 : 1);
  }
  ++number_;
  return true;
}

std::string_view next_word(std::string_view& text) noexcept {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) {
    text = {};
    return {};
  }
  const std::size_t end = text.find_first_of(kBlanks, begin);
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(begin + word.size());
  return word;
}

void split_words(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
    words.push_back(word);
  }
}

std::optional<double> finite_number(std::string_view word) noexcept {
  word = without_plus(word);
  double number = 0.0;
  const auto [stop, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (failure != std::errc{} || stop != word.data() + word.size()) return std::nullopt;
  if (!(std::abs(number) <= static_cast<double>(std::numeric_limits<float>::max()))) {
    return std::nullopt;
  }
  return number;
}

std::optional<long long> whole_number(std::string_view word) noexcept {
  word = without_plus(word);
  long long number = 0;
  const auto [stop, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (failure != std::errc{} || stop != word.data() + word.size()) return std::nullopt;
  return number;
}

}  // namespace nacre

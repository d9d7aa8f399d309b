#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace nacre {

/// Goes through a text line by line. "\n", "\r\n" and a lone "\r" end a line.
class TextLines {
 public:
  /// @param text  must outlive this
  explicit TextLines(std::string_view text) : text_(text) {}

  /// Moves to the next line; false if there is none.
  bool next();

  /// Without its end.
  std::string_view line() const noexcept { return line_; }
  /// Counted from 1.
  std::size_t number() const noexcept { return number_; }
  /// Of the byte after the line's end.
  std::size_t offset() const noexcept { return offset_; }

 private:
  std::string_view text_;
  std::string_view line_;
  std::size_t number_ = 0;
  std::size_t offset_ = 0;
};

/// Takes the next word off the front of a text, without the blanks and line ends around it; empty
/// if there is none.
std::string_view next_word(std::string_view& text) noexcept;

/// The words of a line, into `words`, which is cleared first.
void split_words(std::string_view line, std::vector<std::string_view>& words);

/// A finite decimal number that a float can hold (too small ones count as 0); no hexadecimal
/// digits, nothing behind it.
std::optional<double> finite_number(std::string_view word) noexcept;

/// A whole decimal number.
std::optional<long long> whole_number(std::string_view word) noexcept;

}  // namespace nacre

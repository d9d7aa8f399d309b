#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nacre {

/// "1,2.5,-3" as numbers.
///
/// @param flag      named in the error, e.g. "--window"
/// @param count     how many numbers there must be; 0: any, at least one
/// @param expected  what the flag takes, e.g. "LO,HI"
/// @throws Error    BadArgument if the text is anything else
std::vector<double> parse_numbers(std::string_view flag, const std::string& text, std::size_t count,
                                  std::string_view expected);

/// The same for whole numbers.
std::vector<long long> parse_integers(std::string_view flag, const std::string& text,
                                      std::size_t count, std::string_view expected);

/// The parts of a text between separators; empty parts are kept.
std::vector<std::string> split(std::string_view text, char separator);

}  // namespace nacre

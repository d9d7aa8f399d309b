#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace nacre {

/// Throws Error BadFile with the one line every reader uses: "PATH: found ..., expected ...".
[[noreturn]] void throw_bad_file(const std::filesystem::path& path, const std::string& found,
                                 const std::string& expected);

/// Text from inside a file, fit for a message: unprintable bytes become '?', at most 60 characters.
std::string printable(std::string_view text);

}  // namespace nacre

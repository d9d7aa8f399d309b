#pragma once

#include <functional>
#include <string>

namespace nacre {

/// Says on standard error, in one line, what went wrong.
/// @return  the status, to exit with
int complain(const std::string& program, const std::string& message, int status);

/// Runs a program's work; what it throws becomes a line on standard error and the exit status of
/// cli.md: 2 wrong use, 3 bad input, 4 cannot do it here.
int guarded(const std::string& program, const std::function<int()>& work);

inline constexpr int kWrongUse = 2;

}  // namespace nacre

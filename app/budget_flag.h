#pragma once

#include <string>

#include "shells/budget.h"

namespace nacre {

/// "2MB", "300ktri", "120000": a number with B, kB, MB, GB (powers of 1000), KiB, MiB, GiB, or tri,
/// ktri, Mtri; bytes where it has none.
///
/// @throws Error  BadArgument for anything else, and for what is no whole byte or triangle or more
Budget parse_budget(const std::string& text);

/// "2000000 bytes", "300000 triangles".
std::string budget_words(const Budget& budget);

}  // namespace nacre

#pragma once

#include <optional>
#include <string>

#include "core/shell_set.h"

namespace nacre {

/// What keeps a set's description (all but its surfaces) from being one: numbers that are not
/// finite, levels that do not ascend, a grid that is not exact, ...
///
/// @return  "found ..., expected ..."; nothing if it is sound
std::optional<std::string> shell_set_objection(const ShellSet& set);

}  // namespace nacre

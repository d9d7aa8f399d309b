#pragma once

#include <string_view>

namespace nacre {

/// Whether JSON is nested deep enough to exhaust a stack: to be refused before anything recurses
/// over it.
bool is_json_too_deep(std::string_view text);

}  // namespace nacre

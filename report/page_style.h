#pragma once

#include <string_view>

namespace nacre {

/// The page's style sheet: light, plain, one column on narrow screens.
std::string_view page_style();

}  // namespace nacre

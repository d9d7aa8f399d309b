#pragma once

#include <string>

namespace nacre {

/// The viewer's page without a set: an HTML file that holds `viewer_set_mark()` once, where the set
/// goes. Empty if this build has no page (no Node 18 or later where it was built).
std::string viewer_page();

/// What stands in the page for the set: to be replaced by the bytes of a shell file in base64, or
/// by "fetch:ADDRESS", which is then fetched.
inline const char* viewer_set_mark() noexcept { return "/*NACRE-SET*/"; }

}  // namespace nacre

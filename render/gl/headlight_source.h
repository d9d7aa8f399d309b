#pragma once

#include <string>

namespace nacre {

/// GLSL's `headlight(cosine)`, as in `core/picture.h`, and `linear_depth()`: where `depth_mm` lies
/// in the uniform `depths_mm` (first and last), for depth tests. Depth after a perspective division
/// keeps too few digits for them.
std::string headlight_source();

}  // namespace nacre

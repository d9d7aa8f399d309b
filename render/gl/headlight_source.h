#pragma once

#include <fmt/core.h>

#include <string>

#include "core/picture.h"

namespace nacre {

/// GLSL's `headlight(cosine)`, as in `core/picture.h`, and `linear_depth()`: where `depth_mm` lies
/// in the uniform `depths_mm` (first and last), for depth tests. Depth after a perspective division
/// keeps too few digits for them.
inline std::string headlight_source() {
  return fmt::format(R"(
uniform vec2 depths_mm;
float headlight(float cosine) {{ return {0} + (1.0 - {0}) * max(cosine, 0.0); }}
float linear_depth() {{ return (depth_mm - depths_mm.x) / (depths_mm.y - depths_mm.x); }}
)",
                     kAmbient);
}

}  // namespace nacre

#include "render/gl/headlight_source.h"

#include <fmt/core.h>

#include "core/picture.h"

namespace nacre {

std::string headlight_source() {
  return fmt::format(R"(
uniform vec2 depths_mm;
float headlight(float cosine) {{ return {0} + (1.0 - {0}) * max(cosine, 0.0); }}
float linear_depth() {{ return (depth_mm - depths_mm.x) / (depths_mm.y - depths_mm.x); }}
)",
                     kAmbient);
}

}  // namespace nacre

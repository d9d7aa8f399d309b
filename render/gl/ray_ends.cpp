#include "render/gl/ray_ends.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace nacre {

float no_tool_mm() noexcept { return std::numeric_limits<float>::max(); }

void raise_to_ray_ends(std::span<const float> counts, const std::vector<float>& emission_of_count,
                       std::span<const glm::vec4> tools, const RayFrame& rays, bool at_end,
                       std::span<float> row) {
  const auto most = static_cast<float>(emission_of_count.size() - 1);
  for (std::size_t i = 0; i < row.size(); ++i) {
    const float count = std::round(std::clamp(counts[i], 0.0F, most));
    if (count == 0.0F) continue;
    const double tool_mm = tools.empty() ? no_tool_mm() : tools[i].w;
    if (tool_mm <= 0.0) continue;  // the tool is before the start: nothing of the ray shows
    const double depth_mm = at_end ? std::min(rays.end_mm, tool_mm) : 0.0;
    const double cue =
        std::clamp(rays.cue.x + rays.cue.y * depth_mm, rays.cue_range.x, rays.cue_range.y);
    const double emission = emission_of_count[static_cast<std::size_t>(count)];
    row[i] = std::max(row[i], static_cast<float>(emission * cue));
  }
}

}  // namespace nacre

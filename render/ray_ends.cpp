#include "render/ray_ends.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace nacre {

float no_tool_mm() noexcept { return std::numeric_limits<float>::max(); }

float finite_mm(double depth_mm) noexcept {
  const double largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(depth_mm, -largest, largest));
}

void raise_to_ray_ends(std::span<const float> counts, const std::vector<float>& emission_of_count,
                       std::span<const float> ends_mm, const RayFrame& rays, bool at_end,
                       std::span<float> row) {
  const auto most = static_cast<float>(emission_of_count.size() - 1);
  for (std::size_t i = 0; i < row.size(); ++i) {
    const float count = std::round(std::clamp(counts[i], 0.0F, most));
    if (count == 0.0F || ends_mm[i] <= 0.0F) continue;
    const double emission = emission_of_count[static_cast<std::size_t>(count)];
    const double cue = cue_at_depth(rays, at_end ? double{ends_mm[i]} : 0.0);
    row[i] = std::max(row[i], static_cast<float>(emission * cue));
  }
}

}  // namespace nacre

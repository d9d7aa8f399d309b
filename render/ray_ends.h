#pragma once

#include <span>
#include <vector>

#include "render/ray_frame.h"

namespace nacre {

/// Depth of a tool layer's pixels without a tool; more than that of any tool.
float no_tool_mm() noexcept;

/// A depth as a float: infinite ones become the largest float, which shaders can compare.
float finite_mm(double depth_mm) noexcept;

/// Brightness at the start or end of rays, from the numbers of shells counted there: a maximum
/// takes it where it is more than what the crossings show.
///
/// @param counts             of shells, whole numbers, one a pixel
/// @param emission_of_count  [n] for n shells
/// @param ends_mm            where each pixel's ray ends, beyond its start: by the slab or a tool;
///                           nothing of it shows if that is not positive
/// @param at_end             whether counted at the end of rays; else at their start
/// @param row                the maximum of these pixels so far, raised in place
void raise_to_ray_ends(std::span<const float> counts, const std::vector<float>& emission_of_count,
                       std::span<const float> ends_mm, const RayFrame& rays, bool at_end,
                       std::span<float> row);

}  // namespace nacre

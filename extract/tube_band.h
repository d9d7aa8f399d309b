#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace nacre {

/// A triangle of a band: 0 to n - 1 are the loop's vertices, n to n + 5 those of the waist.
using BandTriangle = std::array<std::uint8_t, 3>;

/// The band between a closed loop and a closed hexagon that runs the same way round: n + 6
/// triangles that follow the loop's direction. Of all such bands the one with the best shaped
/// triangles (least sum of squared sides over area), so that none vanishes.
///
/// @param loop   its n vertices, at least 3 and at most 12
/// @param waist  the hexagon
std::vector<BandTriangle> tube_band(std::span<const glm::dvec3> loop,
                                    std::span<const glm::dvec3, 6> waist);

}  // namespace nacre

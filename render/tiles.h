#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "render/projection.h"

namespace nacre {

/// Rectangles of at most `max_side` pixels a side that cover a picture without overlap, row by row;
/// one for a picture that fits. None is larger than the first.
///
/// @pre size and max_side at least 1
std::vector<PixelRect> tiles(const glm::ivec2& size, int max_side);

/// The pixel whose centre a ray goes through, of an odd number `per_pixel` along each axis; none
/// for the others.
inline std::optional<glm::ivec2> pixel_of(const glm::ivec2& sample, int per_pixel) {
  const glm::ivec2 pixel = sample / per_pixel;
  if (sample != pixel * per_pixel + per_pixel / 2) return std::nullopt;
  return pixel;
}

}  // namespace nacre

#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "render/projection.h"

namespace nacre {

/// Rectangles of at most `max_side` pixels a side that cover a picture without overlap, row by row;
/// one for a picture that fits. None is larger than the first.
///
/// @pre size and max_side at least 1
std::vector<PixelRect> tiles(const glm::ivec2& size, int max_side);

}  // namespace nacre

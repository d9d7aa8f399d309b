#pragma once

#include <span>

#include "core/image.h"

namespace nacre {

/// Pictures of several views as one, the first on top: errors are then taken over all of their
/// pixels, with one peak.
///
/// @throws Error  BadArgument for no pictures, or pictures of different sizes
Image stacked(std::span<const Image> pictures);

}  // namespace nacre

#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/image.h"
#include "core/picture.h"

namespace nacre {

/// The brightness window of a displayed picture: `lo` is shown as black, `hi` as full brightness.
struct DisplayWindow {
  double lo = 0.0;
  double hi = 1.0;
};

/// The usual window of a mode: 0 to 1 for max and iso; 0 to the picture's largest pixel (1 if it is
/// all black) for sum and count.
DisplayWindow default_display_window(const Image& image, PictureMode mode);

/// Colour maps by name. `gray` and `gray-inverted` give gray pictures, the others RGB.
std::span<const std::string_view> color_map_names();

/// Shows a measured picture: window, then colour map, to 16 bits a channel.
///
/// @param color_map  one of `color_map_names()`
/// @throws Error     BadArgument for an unknown colour map, or a window with lo >= hi
DisplayImage display_picture(const Image& image, const DisplayWindow& window,
                             std::string_view color_map = "gray");

}  // namespace nacre

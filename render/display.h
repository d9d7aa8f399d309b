#pragma once

#include <string_view>

#include "core/image.h"
#include "core/picture.h"
#include "render/color_maps.h"

namespace nacre {

/// The brightness window of a displayed picture: `lo` is shown as black, `hi` as full brightness.
struct DisplayWindow {
  double lo = 0.0;
  double hi = 1.0;
};

/// The usual window of a mode: 0 to 1 for max and iso; 0 to the largest pixel (1 if all is black)
/// for sum and count.
DisplayWindow default_display_window(const Image& image, PictureMode mode);

/// The same for the largest pixel of several pictures that are to be shown alike.
DisplayWindow default_display_window(float largest, PictureMode mode);

/// How the volume's display colour V and a tool's colour T, behind it, make one.
enum class ToolBlend {
  /// max(V, T) in each channel where the volume is a maximum, V + T (at most 1) where it is a sum
  /// or count. In iso, where surfaces hide what is behind them, as `Over`.
  Max,
  Over,  ///< V where the volume's part is above 0, else T: [H96]'s drawing order
};

/// How a measured picture is displayed.
struct DisplayOptions {
  DisplayWindow window = {};
  std::string_view color_map = "gray";  ///< one of `color_map_names()`
  PictureMode mode = PictureMode::Max;  ///< of the volume's part
  ToolBlend blend = ToolBlend::Max;
  bool rgb = false;  ///< three channels also where one would do
};

/// Shows a measured picture: window, then colour map, to 16 bits a channel.
///
/// @param color_map  one of `color_map_names()`
/// @throws Error     BadArgument for an unknown colour map, or a window with lo >= hi
DisplayImage display_picture(const Image& image, const DisplayWindow& window,
                             std::string_view color_map = "gray");

/// Shows a measured picture with its tools, which join it after window and colour map in their own
/// colours (cut off at 1). Without a pixel of a tool it is shown as the volume alone, with one
/// channel for a gray map.
///
/// An inverted map shows nothing as white and brightness as darkness, so what adds light there
/// takes it away: the blend is the same on the negatives, min(V, T) and V + T - 1 (at least 0).
/// Vessels in front of a tool darken it, and the tool keeps its colour.
///
/// @pre              the tools' layer has the volume's size
/// @throws Error     BadArgument for an unknown colour map, or a window with lo >= hi
DisplayImage display_picture(const Picture& picture, const DisplayOptions& options);

}  // namespace nacre

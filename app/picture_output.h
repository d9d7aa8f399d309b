#pragma once

#include <optional>
#include <string>

#include "app/camera_flags.h"
#include "core/picture.h"
#include "render/display.h"

namespace nacre {

/// Where a picture goes and how it is displayed there, as flags say it.
struct PictureFlags {
  /// .png, .tif or .tiff; with --turntable holding %03d, or ending in .apng, or empty
  std::string output;
  std::string mode = "max";
  std::string display;  ///< "LO,HI"
  std::string color_map = "gray";
  std::string tool_blend = "max";  ///< max or over
  int bits = 8;
};

/// Adds -o, --mode, --display, --colormap, --tool-blend and --bits.
void add_picture_flags(CLI::App& verb, PictureFlags& flags);

/// @throws Error  BadArgument for an unknown mode
PictureMode picture_mode(const PictureFlags& flags);

/// The brightness window, where it can be told before a picture is there: --display, or the one of
/// the modes max and iso.
/// @throws Error  BadArgument unless --display is two numbers, if it is given
std::optional<DisplayWindow> window_known_before(const PictureFlags& flags);

/// How pictures are displayed with that window.
/// @throws Error  BadArgument for an unknown --tool-blend or mode
DisplayOptions display_options(const PictureFlags& flags, const DisplayWindow& window);

/// Refuses what cannot be written, before any work is done: a missing or unknown output name, a
/// turntable without a number in it, display flags that are wrong.
/// @throws Error  BadArgument
void check_output(const PictureFlags& flags, const CameraFlags& camera);

/// The output's name for a view of a turntable: "%03d" (any width) becomes the view's number.
std::string numbered_name(const std::string& pattern, int number);

}  // namespace nacre

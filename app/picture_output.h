#pragma once

#include <string>

#include "app/camera_flags.h"
#include "core/image.h"
#include "core/picture.h"

namespace nacre {

/// Where a picture goes and how it is displayed there, as flags say it.
struct PictureFlags {
  std::string output;  ///< .png, .tif or .tiff; with --turntable holding %03d, or empty
  std::string mode = "max";
  std::string display;  ///< "LO,HI"
  std::string color_map = "gray";
  int bits = 8;
};

/// Adds -o, --mode, --display, --colormap and --bits.
void add_picture_flags(CLI::App& verb, PictureFlags& flags);

/// @throws Error  BadArgument for an unknown mode
PictureMode picture_mode(const PictureFlags& flags);

/// Refuses what cannot be written, before any work is done: a missing or unknown output name, a
/// turntable without a number in it.
void check_output(const PictureFlags& flags, const CameraFlags& camera);

/// The output's name for a view of a turntable: "%03d" (any width) becomes the view's number.
std::string numbered_name(const std::string& pattern, int number);

/// Writes a TIFF as measured, or a PNG as displayed.
void write_picture(const Image& image, const PictureFlags& flags, const std::string& path);

}  // namespace nacre

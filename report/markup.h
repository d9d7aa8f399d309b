#pragma once

#include <string>
#include <string_view>

#include "core/image.h"

namespace nacre {

/// Text as HTML and SVG want it: & < > " ' become entities.
std::string escaped(std::string_view text);

/// Bytes in base 64 (RFC 4648, section 4), padded.
std::string base64(std::string_view bytes);

/// A picture as the address of a PNG that needs no file: "data:image/png;base64,...".
std::string data_uri(const DisplayImage& picture);

/// The picture at most `side` pixels wide and high: means of whole blocks of pixels, those at the
/// right and lower edge cut.
DisplayImage thumbnail(const DisplayImage& picture, int side);

/// A part of a picture, in pixels.
struct PictureCrop {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// Where a picture is brighter than a hundredth of `peak`, with a margin; all of it if it is
/// nowhere.
PictureCrop lit_part(const Image& image, double peak);

/// @pre  the part lies within the picture
DisplayImage cropped(const DisplayImage& picture, const PictureCrop& part);

}  // namespace nacre

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

}  // namespace nacre

#include "render/display.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/error.h"

namespace nacre {
namespace {

constexpr std::array<std::string_view, 3> kColorMaps{"gray", "gray-inverted", "hot"};

std::uint16_t to_16_bits(double brightness) {
  return static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(brightness, 0.0, 1.0)));
}

/// Black, red, yellow, white: each channel rises over its own third.
void append_hot(double brightness, std::vector<std::uint16_t>& pixels) {
  for (const double start : {0.0, 1.0, 2.0}) pixels.push_back(to_16_bits(3.0 * brightness - start));
}

void check(const DisplayWindow& window, std::string_view color_map) {
  if (!(window.lo < window.hi) || !std::isfinite(window.hi - window.lo)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("display window: found {},{}, expected LO < HI", window.lo, window.hi));
  }
  if (std::find(kColorMaps.begin(), kColorMaps.end(), color_map) == kColorMaps.end()) {
    throw Error(
        ErrorCode::BadArgument,
        fmt::format("colour map: found '{}', expected gray, gray-inverted or hot", color_map));
  }
}

}  // namespace

DisplayWindow default_display_window(const Image& image, PictureMode mode) {
  if (mode == PictureMode::Max || mode == PictureMode::Iso || image.pixels.empty()) return {};
  const float largest = *std::max_element(image.pixels.begin(), image.pixels.end());
  return {0.0, largest > 0.0f ? static_cast<double>(largest) : 1.0};
}

std::span<const std::string_view> color_map_names() { return kColorMaps; }

DisplayImage display_picture(const Image& image, const DisplayWindow& window,
                             std::string_view color_map) {
  check(window, color_map);
  const bool hot = color_map == "hot";
  const bool inverted = color_map == "gray-inverted";
  DisplayImage picture{image.width, image.height, hot ? 3 : 1, {}};
  picture.pixels.reserve(image.pixels.size() * (hot ? 3 : 1));
  for (const float pixel : image.pixels) {
    const double brightness =
        std::clamp((static_cast<double>(pixel) - window.lo) / (window.hi - window.lo), 0.0, 1.0);
    if (hot) {
      append_hot(brightness, picture.pixels);
    } else {
      picture.pixels.push_back(to_16_bits(inverted ? 1.0 - brightness : brightness));
    }
  }
  return picture;
}

}  // namespace nacre

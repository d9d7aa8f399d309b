#include "render/display.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>

#include "core/error.h"

namespace nacre {
namespace {

std::uint16_t to_16_bits(double brightness) {
  return static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(brightness, 0.0, 1.0)));
}

void check(const DisplayWindow& window) {
  if (!(window.lo < window.hi) || !std::isfinite(window.hi - window.lo)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("display window: found {},{}, expected LO < HI", window.lo, window.hi));
  }
}

bool shows_tools(const Picture& picture) {
  return picture.tools.has_value() && any_seen(*picture.tools);
}

/// Light upon light, or the brighter of both.
glm::dvec3 add_light(const glm::dvec3& volume, const glm::dvec3& tool, bool added) {
  return added ? volume + tool : glm::max(volume, tool);
}

/// The colour of a pixel in which a tool is seen.
///
/// @param pixel   of the volume's part, as measured
/// @param volume  its display colour
glm::dvec3 with_tool(float pixel, const glm::dvec3& volume, const glm::dvec3& tool,
                     const ColorMap& map, const DisplayOptions& options) {
  if (options.blend == ToolBlend::Over || options.mode == PictureMode::Iso) {
    return pixel > 0.0F ? volume : tool;
  }
  const bool added = options.mode == PictureMode::Sum || options.mode == PictureMode::Count;
  if (map.is_inverted()) return 1.0 - add_light(1.0 - volume, 1.0 - tool, added);
  return add_light(volume, tool, added);
}

}  // namespace

DisplayWindow default_display_window(const Image& image, PictureMode mode) {
  if (image.pixels.empty()) return {};
  return default_display_window(*std::max_element(image.pixels.begin(), image.pixels.end()), mode);
}

DisplayWindow default_display_window(float largest, PictureMode mode) {
  if (mode == PictureMode::Max || mode == PictureMode::Iso) return {};
  return {0.0, largest > 0.0F ? static_cast<double>(largest) : 1.0};
}

DisplayImage display_picture(const Image& image, const DisplayWindow& window,
                             std::string_view color_map) {
  return display_picture(Picture{image, std::nullopt}, {.window = window, .color_map = color_map});
}

DisplayImage display_picture(const Picture& picture, const DisplayOptions& options) {
  check(options.window);
  const ColorMap map(options.color_map);
  const Image& image = picture.volume;
  const bool tools = shows_tools(picture);
  assert(!tools || picture.tools->covered.size() == image.pixels.size());
  DisplayImage shown{image.width, image.height, tools || options.rgb || !map.is_gray() ? 3 : 1, {}};
  shown.pixels.reserve(image.pixels.size() * static_cast<std::size_t>(shown.channels));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double brightness =
        std::clamp((static_cast<double>(image.pixels[i]) - options.window.lo) /
                       (options.window.hi - options.window.lo),
                   0.0, 1.0);
    glm::dvec3 color = map(brightness);
    if (tools && picture.tools->covered[i] != 0) {
      const glm::dvec3 tool = glm::clamp(glm::dvec3(picture.tools->colors[i]), 0.0, 1.0);
      color = with_tool(image.pixels[i], color, tool, map, options);
    }
    for (int c = 0; c < shown.channels; ++c) shown.pixels.push_back(to_16_bits(color[c]));
  }
  return shown;
}

}  // namespace nacre

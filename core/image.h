#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace nacre {

/// A one-channel float picture: emission (max), emission * mm (sum), or a count.
///
/// Pixel (x, y) is element `x + width * y`, row 0 at the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<float> pixels;  ///< width * height

  float& at(int x, int y) { return pixels[index(x, y)]; }
  float at(int x, int y) const { return pixels[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(width) * static_cast<std::size_t>(y);
  }
};

/// An all-zero picture of that size.
Image make_image(int width, int height);

/// What is seen of the tools in a picture, without the volume.
///
/// Pixel (x, y) is element `x + width * y`, row 0 at the top.
struct ToolLayer {
  int width = 0;
  int height = 0;
  /// RGB, the tool's colour under a headlight times the cue at its depth; black where there is
  /// none. Not above 1 without a cue that is.
  std::vector<glm::vec3> colors;
  std::vector<std::uint8_t> covered;  ///< 1 where a tool is seen (also behind the volume), else 0
};

/// A layer of that size without any tool.
ToolLayer make_tool_layer(int width, int height);

/// A picture as measured: the volume's part, which the tools cut off behind them, and the tools.
struct Picture {
  Image volume;
  std::optional<ToolLayer> tools;  ///< none where no tool is seen
};

/// Whether a tool is seen in any pixel.
bool any_seen(const ToolLayer& tools);

/// Leaves out a layer in which no tool is seen.
void drop_unseen_tools(Picture& picture);

/// A picture for the eye: one (gray) or three (RGB, interleaved) channels of 0 to 65535.
struct DisplayImage {
  int width = 0;
  int height = 0;
  int channels = 1;                   ///< 1 or 3
  std::vector<std::uint16_t> pixels;  ///< width * height * channels
};

}  // namespace nacre

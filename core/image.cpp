#include "core/image.h"

#include <algorithm>

namespace nacre {

Image make_image(int width, int height) {
  Image image;
  image.width = width;
  image.height = height;
  image.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0f);
  return image;
}

ToolLayer make_tool_layer(int width, int height) {
  ToolLayer layer;
  layer.width = width;
  layer.height = height;
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  layer.colors.assign(pixels, glm::vec3(0.0f));
  layer.covered.assign(pixels, 0);
  return layer;
}

bool any_seen(const ToolLayer& tools) {
  return std::find(tools.covered.begin(), tools.covered.end(), 1) != tools.covered.end();
}

void drop_unseen_tools(Picture& picture) {
  if (picture.tools && !any_seen(*picture.tools)) picture.tools.reset();
}

}  // namespace nacre

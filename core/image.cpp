#include "core/image.h"

namespace nacre {

Image make_image(int width, int height) {
  Image image;
  image.width = width;
  image.height = height;
  image.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0f);
  return image;
}

}  // namespace nacre

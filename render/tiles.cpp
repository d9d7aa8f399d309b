#include "render/tiles.h"

#include <algorithm>

namespace nacre {

std::vector<PixelRect> tiles(const glm::ivec2& size, int max_side) {
  std::vector<PixelRect> result;
  for (int y = 0; y < size.y; y += max_side) {
    for (int x = 0; x < size.x; x += max_side) {
      result.push_back({x, y, std::min(max_side, size.x - x), std::min(max_side, size.y - y)});
    }
  }
  return result;
}

}  // namespace nacre

#pragma once

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace nacre {

/// Pixels first.x <= x <= last.x and first.y <= y <= last.y; none if first exceeds last somewhere.
struct PixelRange {
  glm::ivec2 first{0};
  glm::ivec2 last{-1};

  bool empty() const { return first.x > last.x || first.y > last.y; }
};

inline PixelRange intersection(const PixelRange& a, const PixelRange& b) {
  return {glm::max(a.first, b.first), glm::min(a.last, b.last)};
}

}  // namespace nacre

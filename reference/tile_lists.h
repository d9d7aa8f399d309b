#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "reference/pixel_range.h"

namespace nacre {

/// Which things each tile of a picture shows, in the things' order.
struct TileLists {
  glm::ivec2 tiles{0};             ///< across and down
  std::vector<std::size_t> begin;  ///< of each tile's list, row by row; one more at the end
  std::vector<std::uint32_t> items;

  std::span<const std::uint32_t> of(std::size_t tile) const {
    return std::span(items).subspan(begin[tile], begin[tile + 1] - begin[tile]);
  }

  /// The pixels of a tile.
  /// @param side  as the lists were made with
  PixelRange pixels(std::size_t tile, int side, const glm::ivec2& size) const {
    const auto across = static_cast<std::size_t>(tiles.x);
    const glm::ivec2 first = side * glm::ivec2(tile % across, tile / across);
    return {first, glm::min(first + side, size) - 1};
  }
};

/// Puts each thing into the lists of the tiles that its rectangle meets. On all cores; the same for
/// any number of them.
///
/// @param rectangles  in pixels, within the picture; empty ones are nowhere. Below 2^32 of them
/// @param side        of a tile, pixels
TileLists make_tile_lists(std::span<const PixelRange> rectangles, const glm::ivec2& size, int side);

}  // namespace nacre

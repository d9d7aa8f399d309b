#include "reference/tile_lists.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace nacre {
namespace {

constexpr std::size_t kMostChunks = 16;  // each needs a count a tile
constexpr std::size_t kLeastChunk = 1024;

/// Things are counted a chunk at a time.
struct Chunks {
  explicit Chunks(std::size_t all)
      : things(all),
        size(std::max(kLeastChunk, (all + kMostChunks - 1) / kMostChunks)),
        count((all + size - 1) / size) {}

  std::size_t things;
  std::size_t size;
  std::size_t count;
};

template <class OnTile>
void for_tiles(const PixelRange& rectangle, int side, int across, const OnTile& on_tile) {
  if (rectangle.empty()) return;
  for (int y = rectangle.first.y / side; y <= rectangle.last.y / side; ++y) {
    for (int x = rectangle.first.x / side; x <= rectangle.last.x / side; ++x) {
      on_tile(static_cast<std::size_t>(y) * static_cast<std::size_t>(across) +
              static_cast<std::size_t>(x));
    }
  }
}

template <class OnThing>
void for_things(const Chunks& chunks, const OnThing& on_thing) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, chunks.count, 1), [&](const auto& range) {
    for (std::size_t chunk = range.begin(); chunk != range.end(); ++chunk) {
      const std::size_t end = std::min((chunk + 1) * chunks.size, chunks.things);
      for (std::size_t i = chunk * chunks.size; i < end; ++i) on_thing(chunk, i);
    }
  });
}

}  // namespace

TileLists make_tile_lists(std::span<const PixelRange> rectangles, const glm::ivec2& size,
                          int side) {
  TileLists lists;
  lists.tiles = (size + (side - 1)) / side;
  const std::size_t tiles =
      static_cast<std::size_t>(lists.tiles.x) * static_cast<std::size_t>(lists.tiles.y);
  const Chunks chunks(rectangles.size());

  // How many each chunk puts into each tile; then where its first one goes.
  std::vector<std::size_t> place(chunks.count * tiles, 0);
  for_things(chunks, [&](std::size_t chunk, std::size_t i) {
    for_tiles(rectangles[i], side, lists.tiles.x,
              [&](std::size_t tile) { ++place[chunk * tiles + tile]; });
  });
  lists.begin.resize(tiles + 1);
  std::size_t total = 0;
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    lists.begin[tile] = total;
    for (std::size_t chunk = 0; chunk < chunks.count; ++chunk) {
      const std::size_t count = place[chunk * tiles + tile];
      place[chunk * tiles + tile] = total;
      total += count;
    }
  }
  lists.begin[tiles] = total;
  lists.items.resize(total);
  for_things(chunks, [&](std::size_t chunk, std::size_t i) {
    for_tiles(rectangles[i], side, lists.tiles.x, [&](std::size_t tile) {
      lists.items[place[chunk * tiles + tile]++] = static_cast<std::uint32_t>(i);
    });
  });
  return lists;
}

}  // namespace nacre

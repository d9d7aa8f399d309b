#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "extract/chunk_arena.h"

namespace nacre {

/// Elements appended one after the other, in chunks of an arena: nothing moves while it grows.
template <class Element>
class ChunkedStream {
 public:
  /// As many as a cell's contour has triangles, in the usual cases.
  static constexpr std::size_t kRoom = 5;

  /// Room for `kRoom` more elements; `commit` says how many of them were written.
  Element* room(ChunkArena& arena) {
    if (cursor_ >= full_at_) add_chunk(arena);
    return cursor_;
  }
  void commit(std::size_t count) { cursor_ += count; }

  void push(const Element& element, ChunkArena& arena) {
    *room(arena) = element;
    commit(1);
  }

  std::size_t size() const {
    auto sum = static_cast<std::size_t>(cursor_ - begin_);
    for (const std::span<Element> chunk : full_) sum += chunk.size();
    return sum;
  }

  /// Forgets all elements, before the arena takes its memory back.
  void clear() {
    full_.clear();
    begin_ = cursor_ = full_at_ = nullptr;
    next_chunk_ = kFirstChunk;
  }

  /// Calls `function(std::span<Element>)` with each chunk in order.
  template <class Function>
  void for_each_chunk(Function&& function) {
    for (const std::span<Element> chunk : full_) function(chunk);
    function(std::span<Element>(begin_, cursor_));
  }

 private:
  static constexpr std::size_t kFirstChunk = 64;
  static constexpr std::size_t kLargestChunk = 4096;

  void add_chunk(ChunkArena& arena) {
    if (begin_ != nullptr) full_.emplace_back(begin_, cursor_);
    begin_ = cursor_ = static_cast<Element*>(arena.allocate(next_chunk_ * sizeof(Element)));
    full_at_ = begin_ + (next_chunk_ - kRoom + 1);
    next_chunk_ = std::min(2 * next_chunk_, kLargestChunk);
  }

  std::vector<std::span<Element>> full_;
  Element* begin_ = nullptr;
  Element* cursor_ = nullptr;
  Element* full_at_ = nullptr;  ///< the first place with too little room
  std::size_t next_chunk_ = kFirstChunk;
};

/// One level's surface as one slab of the sweep makes it.
///
/// Vertices are numbered within the slab: first those of the slab's lowest slice, which the slab
/// below makes too and which only that one writes (*shared* ones), then the slab's own.
struct LevelOutput {
  ChunkedStream<glm::vec3> positions;   ///< of the slab's own vertices
  ChunkedStream<glm::uvec3> triangles;  ///< indices within the slab
  std::uint64_t next_vertex = 0;
  std::uint64_t shared_count = 0;  ///< vertices of the lowest slice; 0 in the first slab
  std::uint64_t top_begin = 0;     ///< first vertex of the highest slice

  void clear() {
    positions.clear();
    triangles.clear();
    next_vertex = shared_count = top_begin = 0;
  }

  std::uint32_t new_vertex() { return static_cast<std::uint32_t>(next_vertex++); }
};

/// All levels' surfaces of one slab, and the memory they lie in.
struct SlabOutput {
  explicit SlabOutput(std::size_t level_count = 0) : levels(level_count) {}

  /// Makes it as at first, for another slab; the memory stays.
  void clear() {
    for (LevelOutput& level : levels) level.clear();
    arena.clear();
  }

  void write_position(std::size_t k, const glm::dvec3& position_mm) {
    levels[k].positions.push(glm::vec3(position_mm), arena);
  }

  void write_triangle(std::size_t k, const glm::uvec3& triangle) {
    levels[k].triangles.push(triangle, arena);
  }

  std::vector<LevelOutput> levels;
  ChunkArena arena;
};

}  // namespace nacre

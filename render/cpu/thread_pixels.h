#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <span>

#include "render/cpu/cluster_kernel.h"

namespace nacre {

/// The pixels of a picture, drawn by many threads without a lock: each has pixels of its own, which
/// are merged at the end (see `PixelTarget`). Merging does not depend on the order.
template <class Pixel>
class ThreadPixels {
 public:
  ThreadPixels();
  ~ThreadPixels();
  ThreadPixels(ThreadPixels&&) noexcept;
  ThreadPixels& operator=(ThreadPixels&&) noexcept;

  /// Starts a picture of that size, all pixels 0.
  void begin(const glm::ivec2& size);

  /// The calling thread's pixels.
  PixelTarget<Pixel> target();

  /// Merges all threads' pixels and hands over row after row, from several threads at once; none if
  /// no thread has drawn.
  ///
  /// @param show  takes the row's number and its pixels
  void merge(const std::function<void(int, std::span<const Pixel>)>& show);

  /// The pixels of all threads, merged, row by row; valid until the next picture begins.
  std::span<Pixel> merged();

  /// Bytes of all threads' pixels.
  std::size_t bytes() const;

 private:
  class Layers;
  std::unique_ptr<Layers> layers_;
};

}  // namespace nacre

#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <memory>
#include <span>

#include "core/image.h"
#include "render/cpu/cluster_kernel.h"
#include "render/projection.h"

namespace nacre {

/// The greatest rank (bytes, words) or emission (floats) of each pixel, gathered by many threads
/// without a lock: each has pixels of its own, and `resolve` takes the greatest of them.
template <class Pixel>
class MaxPicture {
 public:
  MaxPicture();
  ~MaxPicture();
  MaxPicture(MaxPicture&&) noexcept;
  MaxPicture& operator=(MaxPicture&&) noexcept;

  /// Starts a picture of that size, all pixels 0.
  void begin(const glm::ivec2& size);

  /// The calling thread's pixels.
  PixelTarget<Pixel> target();

  /// Writes the emission of each pixel into a rectangle of the image.
  ///
  /// @param emission_of_rank  not looked at where pixels are emissions
  /// @pre  the rectangle has the picture's size; ranks are below emission_of_rank.size()
  void resolve(std::span<const float> emission_of_rank, const PixelRect& rect, Image& image);

  /// Bytes of all threads' pixels.
  std::size_t bytes() const;

 private:
  class Layers;
  std::unique_ptr<Layers> layers_;
};

}  // namespace nacre

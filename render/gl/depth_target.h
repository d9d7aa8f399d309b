#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "render/gl/gl_objects.h"
#include "render/render_options.h"

namespace nacre {

/// A framebuffer of depth alone.
class DepthTarget {
 public:
  /// @throws Error           Unsupported if the driver cannot draw to it
  /// @throws std::bad_alloc  if there is no room for it
  DepthTarget(const GlFunctions& gl, const glm::ivec2& size, DepthFormat format);

  const glm::ivec2& size() const noexcept { return size_; }
  DepthFormat format() const noexcept { return format_; }

  /// Makes it the target, the viewport its first rows and columns, and every depth 0.
  /// @pre  not larger than `size()`
  void begin(const glm::ivec2& viewport) const;

  /// Depths in [0, 1] of its first rows and columns, waiting until they are drawn.
  /// @param depths      the upper left one of where they go, first row first
  /// @param row_length  elements from one row of `depths` to the next
  void read(const glm::ivec2& size, float* depths, int row_length) const;

 private:
  const GlFunctions* gl_;
  glm::ivec2 size_;
  DepthFormat format_;
  GlRenderbuffer depth_;
  GlFramebuffer framebuffer_;
};

}  // namespace nacre

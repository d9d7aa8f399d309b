#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "render/gl/gl_objects.h"
#include "render/render_options.h"

namespace nacre {

/// What a colour target holds in a pixel: one channel, or four floats.
enum class ColorFormat { R8, R16F, R32F, Rgba32F };

/// What a framebuffer consists of.
struct TargetLayout {
  std::optional<ColorFormat> color = std::nullopt;
  std::optional<DepthFormat> depth = std::nullopt;

  bool operator==(const TargetLayout&) const = default;
};

/// A framebuffer of a colour texture, a depth buffer, or both.
class RenderTarget {
 public:
  /// @throws Error           Unsupported if the driver cannot draw to it
  /// @throws std::bad_alloc  if there is no room for it
  RenderTarget(const GlFunctions& gl, const glm::ivec2& size, const TargetLayout& layout);

  const glm::ivec2& size() const noexcept { return size_; }
  const TargetLayout& layout() const noexcept { return layout_; }

  /// Bytes of all its pixels.
  std::size_t bytes() const noexcept;

  /// The colour texture's name.
  unsigned texture() const noexcept { return color_.id(); }

  /// Makes it the target, the viewport its first rows and columns, and clears it.
  /// @pre  not larger than `size()`
  void begin(const glm::ivec2& viewport, float depth, const glm::vec4& color = {}) const;

  /// Depths in [0, 1] of its first rows and columns, waiting until they are drawn.
  /// @param depths      the upper left one of where they go, first row first
  /// @param row_length  elements from one row of `depths` to the next
  void read_depth(const glm::ivec2& size, float* depths, int row_length) const;

  /// The first channel of its colours in the same way.
  void read_red(const glm::ivec2& size, float* values, int row_length) const;

  /// All four channels, row after row.
  void read_rgba(const glm::ivec2& size, glm::vec4* colors) const;

 private:
  void attach_color(ColorFormat format);
  void attach_depth(DepthFormat format);
  void read(const glm::ivec2& size, unsigned format, float* values, int row_length) const;

  const GlFunctions* gl_;
  glm::ivec2 size_;
  TargetLayout layout_;
  GlTexture color_;
  GlRenderbuffer depth_;
  GlFramebuffer framebuffer_;
};

}  // namespace nacre

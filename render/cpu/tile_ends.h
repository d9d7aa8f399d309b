#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "render/cpu/cluster_kernel.h"
#include "render/ray_frame.h"

namespace nacre {

/// Where the rays of a tile's pixels start and end: by the slab, or sooner by tools.
class TileEnds {
 public:
  /// All rays end with the slab.
  void begin(const glm::ivec2& size, const RayFrame& rays);

  /// A tool in that pixel: the ray ends there if it did not before. Pixels of different rows may be
  /// lowered at once.
  void lower(int x, int y, float depth_mm);

  /// To be called when all tools are in.
  void find_range();

  /// The ends of a row of pixels, beyond the start of the rays.
  std::span<const float> row(int y) const;

  RayEnds ends() const;

  /// Starts of rays as ends: what lies beyond them.
  RayEnds starts();

  std::size_t bytes() const;

 private:
  glm::ivec2 size_{0};
  std::vector<float> ends_mm_;
  std::vector<float> starts_mm_;
  float least_mm_ = 0.0F;
  float greatest_mm_ = 0.0F;
};

}  // namespace nacre

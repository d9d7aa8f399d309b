#include "render/cpu/tile_ends.h"

#include <algorithm>

#include "render/ray_ends.h"

namespace nacre {
namespace {

std::size_t area(const glm::ivec2& size) {
  return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
}

}  // namespace

void TileEnds::begin(const glm::ivec2& size, const RayFrame& rays) {
  size_ = size;
  least_mm_ = greatest_mm_ = finite_mm(rays.end_mm);
  ends_mm_.assign(area(size), least_mm_);
}

void TileEnds::lower(int x, int y, float depth_mm) {
  float& end_mm = ends_mm_[area({size_.x, y}) + static_cast<std::size_t>(x)];
  end_mm = std::min(end_mm, depth_mm);
}

void TileEnds::find_range() {
  const auto [least, greatest] = std::minmax_element(ends_mm_.begin(), ends_mm_.end());
  least_mm_ = *least;
  greatest_mm_ = *greatest;
}

std::span<const float> TileEnds::row(int y) const {
  return std::span(ends_mm_).subspan(area({size_.x, y}), static_cast<std::size_t>(size_.x));
}

RayEnds TileEnds::ends() const { return {ends_mm_.data(), least_mm_, greatest_mm_}; }

RayEnds TileEnds::starts() {
  starts_mm_.assign(ends_mm_.size(), 0.0F);
  return {starts_mm_.data(), 0.0F, 0.0F};
}

std::size_t TileEnds::bytes() const {
  return (ends_mm_.capacity() + starts_mm_.capacity()) * sizeof(float);
}

}  // namespace nacre

#include "extract/surface_merge.h"

#include <fmt/core.h>

#include <limits>

#include "core/error.h"

namespace nacre {

SurfaceMerge::SurfaceMerge(std::span<SlabOutput> slabs, std::size_t level)
    : slabs_(slabs), level_(level) {
  std::uint64_t top_of_slab_below = 0;
  for (const SlabOutput& slab : slabs) {
    const LevelOutput& part = slab[level];
    const std::uint64_t own_offset = vertex_count_ - part.shared_count;
    renumberings_.push_back({.shared_count = static_cast<std::uint32_t>(part.shared_count),
                             .shared_offset = static_cast<std::uint32_t>(top_of_slab_below),
                             .own_offset = static_cast<std::uint32_t>(own_offset)});
    top_of_slab_below = own_offset + part.top_begin;
    vertex_count_ += part.next_vertex - part.shared_count;
  }
  if (vertex_count_ > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("surface of level {}: found {} vertices, expected at most 2^32 - 1",
                            level, vertex_count_));
  }
}

void SurfaceMerge::positions(std::vector<glm::vec3>& merged) {
  merged.reserve(static_cast<std::size_t>(vertex_count_));
  for (SlabOutput& slab : slabs_) {
    slab[level_].positions.drain([&merged](std::span<const glm::vec3> chunk) {
      merged.insert(merged.end(), chunk.begin(), chunk.end());
    });
  }
}

void SurfaceMerge::triangles(std::vector<glm::uvec3>& merged) {
  std::size_t count = 0;
  for (const SlabOutput& slab : slabs_) count += slab[level_].triangles.size();
  merged.reserve(count);
  for (std::size_t s = 0; s < slabs_.size(); ++s) {
    const auto [shared_count, shared_offset, own_offset] = renumberings_[s];
    slabs_[s][level_].triangles.drain([&](std::span<glm::uvec3> chunk) {
      for (glm::uvec3& triangle : chunk) {
        for (int i = 0; i < 3; ++i) {
          triangle[i] += triangle[i] < shared_count ? shared_offset : own_offset;
        }
      }
      merged.insert(merged.end(), chunk.begin(), chunk.end());
    });
  }
}

}  // namespace nacre

#include "extract/surface_merge.h"

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include <limits>
#include <utility>
#include <vector>

#include "core/error.h"

namespace nacre {

PartSizes sizes_of(const LevelOutput& part) {
  return {part.next_vertex, part.shared_count, part.top_begin, part.triangles.size()};
}

MergePlan plan_merge(std::span<const PartSizes> parts, std::size_t level) {
  MergePlan plan;
  std::uint64_t top_of_slab_below = 0;
  std::uint64_t vertices = 0;
  for (const PartSizes& part : parts) {
    const std::uint64_t own_offset = vertices - part.shared_count;
    plan.parts.push_back({.shared_count = static_cast<std::uint32_t>(part.shared_count),
                          .shared_offset = static_cast<std::uint32_t>(top_of_slab_below),
                          .own_offset = static_cast<std::uint32_t>(own_offset)});
    top_of_slab_below = own_offset + part.top_begin;
    vertices += part.vertices - part.shared_count;
    plan.triangles += part.triangles;
  }
  if (vertices > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("surface of level {}: found {} vertices, expected at most 2^32 - 1",
                            level + 1, vertices));
  }
  plan.vertices = static_cast<std::size_t>(vertices);
  return plan;
}

void renumber(std::span<glm::uvec3> triangles, const Renumbering& renumbering, bool reversed) {
  const auto [shared_count, shared_offset, own_offset] = renumbering;
  for (glm::uvec3& triangle : triangles) {
    for (int i = 0; i < 3; ++i) {
      triangle[i] += triangle[i] < shared_count ? shared_offset : own_offset;
    }
    if (reversed) std::swap(triangle.y, triangle.z);
  }
}

void append_positions(LevelOutput& part, std::vector<glm::vec3>& merged) {
  part.positions.for_each_chunk([&merged](std::span<const glm::vec3> chunk) {
    merged.insert(merged.end(), chunk.begin(), chunk.end());
  });
}

void append_triangles(LevelOutput& part, const Renumbering& renumbering, bool reversed,
                      std::vector<glm::uvec3>& merged) {
  part.triangles.for_each_chunk([&](std::span<glm::uvec3> chunk) {
    renumber(chunk, renumbering, reversed);
    merged.insert(merged.end(), chunk.begin(), chunk.end());
  });
}

void merge_slabs(std::span<SlabOutput> slabs, bool reversed, std::span<TriangleMesh> meshes) {
  std::vector<MergePlan> plans;
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    std::vector<PartSizes> parts;
    for (const SlabOutput& slab : slabs) parts.push_back(sizes_of(slab.levels[k]));
    plans.push_back(plan_merge(parts, k));
    meshes[k].positions.reserve(plans[k].vertices);
    meshes[k].triangles.reserve(plans[k].triangles);
  }
  // Slab by slab, so that what is copied can be freed: surfaces and slabs together stay about as
  // large as the surfaces. A level's vertices and triangles are two tasks.
  for (std::size_t s = 0; s < slabs.size(); ++s) {
    tbb::parallel_for(std::size_t{0}, 2 * meshes.size(), [&](std::size_t task) {
      const std::size_t k = task / 2;
      LevelOutput& part = slabs[s].levels[k];
      if (task % 2 == 0) {
        append_positions(part, meshes[k].positions);
      } else {
        append_triangles(part, plans[k].parts[s], reversed, meshes[k].triangles);
      }
    });
    slabs[s] = SlabOutput();
  }
}

}  // namespace nacre

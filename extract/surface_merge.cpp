#include "extract/surface_merge.h"

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include <limits>
#include <utility>
#include <vector>

#include "core/error.h"

namespace nacre {
namespace {

/// How each slab's numbers of one level change; makes room for the whole surface.
std::vector<Renumbering> plan_level(std::span<const SlabOutput> slabs, std::size_t level,
                                    TriangleMesh& mesh) {
  std::vector<Renumbering> plan;
  std::uint64_t top_of_slab_below = 0;
  std::uint64_t vertices = 0;
  std::size_t triangles = 0;
  for (const SlabOutput& slab : slabs) {
    const LevelOutput& part = slab.levels[level];
    const std::uint64_t own_offset = vertices - part.shared_count;
    plan.push_back({.shared_count = static_cast<std::uint32_t>(part.shared_count),
                    .shared_offset = static_cast<std::uint32_t>(top_of_slab_below),
                    .own_offset = static_cast<std::uint32_t>(own_offset)});
    top_of_slab_below = own_offset + part.top_begin;
    vertices += part.next_vertex - part.shared_count;
    triangles += part.triangles.size();
  }
  if (vertices > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("surface of level {}: found {} vertices, expected at most 2^32 - 1",
                            level + 1, vertices));
  }
  mesh.positions.reserve(static_cast<std::size_t>(vertices));
  mesh.triangles.reserve(triangles);
  return plan;
}

void append_positions(LevelOutput& part, std::vector<glm::vec3>& merged) {
  part.positions.for_each_chunk([&merged](std::span<const glm::vec3> chunk) {
    merged.insert(merged.end(), chunk.begin(), chunk.end());
  });
}

void append_triangles(LevelOutput& part, const Renumbering& renumbering, bool reversed,
                      std::vector<glm::uvec3>& merged) {
  const auto [shared_count, shared_offset, own_offset] = renumbering;
  part.triangles.for_each_chunk([&](std::span<glm::uvec3> chunk) {
    for (glm::uvec3& triangle : chunk) {
      for (int i = 0; i < 3; ++i) {
        triangle[i] += triangle[i] < shared_count ? shared_offset : own_offset;
      }
      if (reversed) std::swap(triangle.y, triangle.z);
    }
    merged.insert(merged.end(), chunk.begin(), chunk.end());
  });
}

}  // namespace

void merge_slabs(std::span<SlabOutput> slabs, bool reversed, std::span<TriangleMesh> meshes) {
  std::vector<std::vector<Renumbering>> plans;
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    plans.push_back(plan_level(slabs, k, meshes[k]));
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
        append_triangles(part, plans[k][s], reversed, meshes[k].triangles);
      }
    });
    slabs[s] = SlabOutput();
  }
}

}  // namespace nacre

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "extract/level_output.h"

namespace nacre {

/// Joins the slabs' parts of one level, lowest slab first. A slab's vertices follow those of the
/// slabs below it; the vertices of its lowest slice are those of the highest slice of the slab
/// below. No sample is looked at again, and the slabs' memory is given back on the way.
///
/// `positions` and `triangles` may run at once, for one level and for several.
class SurfaceMerge {
 public:
  /// @throws Error  Unsupported for more than 2^32 - 1 vertices
  SurfaceMerge(std::span<SlabOutput> slabs, std::size_t level);

  void positions(std::vector<glm::vec3>& merged);
  void triangles(std::vector<glm::uvec3>& merged);

 private:
  /// How a slab's numbers become the surface's: below `shared_count` and from there on.
  struct Renumbering {
    std::uint32_t shared_count;
    std::uint32_t shared_offset;  ///< added modulo 2^32
    std::uint32_t own_offset;
  };

  std::span<SlabOutput> slabs_;
  std::size_t level_;
  std::vector<Renumbering> renumberings_;
  std::uint64_t vertex_count_ = 0;
};

}  // namespace nacre

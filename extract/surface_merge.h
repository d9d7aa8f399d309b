#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "extract/level_output.h"

namespace nacre {

<<<<<<< HEAD
/// How the vertex numbers of one level in one slab become those of the whole surface.
struct Renumbering {
  std::uint32_t shared_count = 0;   ///< numbers below this are of the slab below
  std::uint32_t shared_offset = 0;  ///< added to them, modulo 2^32
  std::uint32_t own_offset = 0;     ///< added to the others
};

/// Joins the slabs' parts of all surfaces, lowest slab first, and gives each slab's memory back on
/// the way. A slab's vertices follow those of the slabs below it; the vertices of its lowest slice
/// are those of the highest slice of the slab below. No sample is looked at again.
///
/// @param reversed  turn the triangles round
/// @param meshes    one for each level; out
/// @throws Error    Unsupported for more than 2^32 - 1 vertices in one surface
void merge_slabs(std::span<SlabOutput> slabs, bool reversed, std::span<TriangleMesh> meshes);

=======
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

>>>>>>> shells
}  // namespace nacre

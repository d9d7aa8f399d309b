#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "extract/level_output.h"

namespace nacre {

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

}  // namespace nacre

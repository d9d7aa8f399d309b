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

/// How large one slab's part of one level is, see `LevelOutput`.
struct PartSizes {
  std::uint64_t vertices = 0;  ///< shared ones too
  std::uint64_t shared_count = 0;
  std::uint64_t top_begin = 0;
  std::size_t triangles = 0;
};

PartSizes sizes_of(const LevelOutput& part);

/// How the parts of one level, lowest slab first, become one surface.
struct MergePlan {
  std::vector<Renumbering> parts;
  std::size_t vertices = 0;
  std::size_t triangles = 0;
};

/// @param level   for the message
/// @throws Error  Unsupported for more than 2^32 - 1 vertices
MergePlan plan_merge(std::span<const PartSizes> parts, std::size_t level);

/// Gives a part's triangles their numbers in the whole surface.
/// @param reversed  turn them round
void renumber(std::span<glm::uvec3> triangles, const Renumbering& renumbering, bool reversed);

/// Appends one slab's part of a level to the whole surface.
void append_positions(LevelOutput& part, std::vector<glm::vec3>& merged);
void append_triangles(LevelOutput& part, const Renumbering& renumbering, bool reversed,
                      std::vector<glm::uvec3>& merged);

/// Joins the slabs' parts of all surfaces, lowest slab first, and gives each slab's memory back on
/// the way. A slab's vertices follow those of the slabs below it; the vertices of its lowest slice
/// are those of the highest slice of the slab below. No sample is looked at again.
///
/// @param reversed  turn the triangles round
/// @param meshes    one for each level; out
/// @throws Error    Unsupported for more than 2^32 - 1 vertices in one surface
void merge_slabs(std::span<SlabOutput> slabs, bool reversed, std::span<TriangleMesh> meshes);

}  // namespace nacre

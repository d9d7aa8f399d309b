#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "extract/level_output.h"
#include "extract/scratch_file.h"

namespace nacre {

/// One level's surface, to which the slabs of a sweep add their parts, lowest slab first. A slab's
/// vertices follow those of the slabs below it; the vertices of its lowest slice are those of the
/// highest slice of the slab below. No sample is looked at again.
///
/// Parts are appended in memory or, from some slab on, in a file; where the disk is full, memory
/// holds the rest.
class GrowingSurface {
 public:
  /// @param part      its triangles are renumbered in place
  /// @param level     its number, for the message
  /// @param reversed  turn the triangles round
  /// @param share     slabs up to this one of all slabs, in (0, 1]: tells how much room to make
  /// @param file      where the part goes; null: memory
  /// @throws Error    Unsupported for more than 2^32 - 1 vertices
  void append(LevelOutput& part, std::size_t level, bool reversed, double share, ScratchFile* file);

  std::size_t triangle_count() const { return triangles_; }

  /// The whole surface. Once.
  /// @param file    of the parts that are in one
  /// @throws Error  Unsupported if it cannot be read back
  TriangleMesh take(const ScratchFile* file);

 private:
  /// A part in the file.
  struct Place {
    std::uint64_t positions = 0;
    std::uint64_t triangles = 0;
    std::size_t position_count = 0;
    std::size_t triangle_count = 0;
  };

  /// How a part's numbers become those of the whole surface.
  struct Numbering {
    std::uint32_t shared_count = 0;   ///< numbers below it are of the slab below
    std::uint32_t shared_offset = 0;  ///< to be added to them
    std::uint32_t own_offset = 0;     ///< to be added to the others
    bool reversed = false;            ///< turn the triangles round
  };

  Numbering number(const LevelOutput& part, std::size_t level, bool reversed);
  static void renumber(std::span<glm::uvec3> triangles, const Numbering& numbering);
  void append_triangles(ChunkedStream<glm::uvec3>& stream, const Numbering& numbering, double share,
                        std::vector<glm::uvec3>& triangles);
  bool store(LevelOutput& part, ScratchFile& file);

  std::uint64_t vertices_ = 0;
  std::uint64_t top_begin_ = 0;  ///< first vertex of the highest slice
  std::size_t triangles_ = 0;
  TriangleMesh head_;          ///< lowest slabs
  std::vector<Place> places_;  ///< those above them
  TriangleMesh tail_;          ///< those that the disk had no room for
  bool is_disk_full_ = false;
};

}  // namespace nacre

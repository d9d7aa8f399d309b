#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/triangle_mesh.h"
#include "extract/level_output.h"
#include "extract/scratch_file.h"
#include "extract/surface_merge.h"

namespace nacre {

/// Where surfaces wait until they are asked for.
struct SurfaceStorage {
  /// Folder of a nameless file for what shall not stand in memory; none: memory holds all.
  std::optional<std::filesystem::path> scratch_folder = {};
  /// Bytes of surfaces that stay in memory all the same.
  std::size_t memory_bytes = 0;
};

/// The surfaces of some levels as one sweep leaves them, slab by slab: in memory up to a limit, in
/// a nameless file beyond it, and joined level by level when asked for. Where the file cannot be
/// made or the disk is full, memory holds the rest.
class SurfaceParts {
 public:
  /// @param reversed  turn the triangles round
  SurfaceParts(std::size_t slab_count, std::size_t level_count, bool reversed,
               const SurfaceStorage& storage);

  /// Keeps a slab's output. Once a slab; safe to call from any thread.
  void put(std::size_t slab, SlabOutput output);

  /// When all slabs are there: joins them, if memory holds all.
  void settle();

  std::size_t level_count() const noexcept { return joined_.size(); }
  std::size_t triangle_count(std::size_t level) const;

  /// A level's whole surface. Once a level; safe to call from any thread.
  /// @throws Error  Unsupported for more than 2^32 - 1 vertices, or if the scratch file cannot be
  ///                read back
  TriangleMesh take(std::size_t level);

 private:
  /// Where a level's part of a slab lies in the scratch file.
  struct Place {
    std::uint64_t positions = 0;
    std::uint64_t triangles = 0;
  };
  struct Part {
    std::vector<PartSizes> sizes;  ///< of each level
    SlabOutput output;             ///< if it stays in memory
    std::vector<Place> places;     ///< of each level, if it does not
  };

  std::optional<Place> store(LevelOutput& output);
  bool store(SlabOutput& output, std::vector<Place>& places);
  void append(Part& part, std::size_t level, const Renumbering& renumbering, TriangleMesh& mesh);

  bool reversed_;
  std::size_t memory_bytes_;
  std::optional<ScratchFile> scratch_;
  std::atomic<std::size_t> held_bytes_{0};
  std::vector<Part> parts_;           ///< of each slab
  std::vector<TriangleMesh> joined_;  ///< of each level, once memory holds all
  bool is_joined_ = false;
};

}  // namespace nacre

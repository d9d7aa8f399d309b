#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/triangle_mesh.h"
#include "extract/growing_surface.h"
#include "extract/level_output.h"
#include "extract/scratch_file.h"

namespace nacre {

/// Where surfaces wait until they are asked for.
struct SurfaceStorage {
  /// Folder of a nameless file for what shall not stand in memory; none: memory holds all.
  std::optional<std::filesystem::path> scratch_folder = {};
  /// Bytes of surfaces that stay in memory all the same.
  std::size_t memory_bytes = 0;
};

/// The surfaces of some levels as one sweep makes them, slab by slab: in memory up to a limit, in a
/// nameless file beyond it. Where the file cannot be made or the disk is full, memory holds the
/// rest.
class SweptSurfaces {
 public:
  /// @param reversed  turn the triangles round
  SweptSurfaces(std::size_t slab_count, std::size_t level_count, bool reversed,
                const SurfaceStorage& storage);

  /// Appends the next slab's output, lowest slab first, its levels side by side.
  /// @throws Error  Unsupported for a surface of more than 2^32 - 1 vertices
  void append(SlabOutput& output);

  /// Whether slabs go to the file by now.
  bool is_storing() const noexcept { return is_storing_; }

  std::size_t level_count() const noexcept { return surfaces_.size(); }
  std::size_t triangle_count(std::size_t level) const { return surfaces_[level].triangle_count(); }

  /// A level's whole surface. Once a level; safe to call from any thread.
  /// @throws Error  Unsupported if the scratch file cannot be read back
  TriangleMesh take(std::size_t level);

 private:
  ScratchFile* file() { return scratch_ ? &*scratch_ : nullptr; }

  std::size_t slab_count_;
  bool reversed_;
  std::size_t memory_bytes_;
  std::optional<ScratchFile> scratch_;
  bool is_storing_ = false;
  std::size_t slabs_ = 0;  ///< appended
  std::size_t held_bytes_ = 0;
  std::vector<GrowingSurface> surfaces_;  ///< of each level
};

}  // namespace nacre

#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/volume.h"

namespace nacre {

/// Least and greatest stored sample over the cells of each brick of 8 x 8 x 8 cells (so over up to
/// 9 x 9 x 9 samples): what the trilinear field can be inside. Built in parallel, in one pass.
struct VolumeBricks {
  static constexpr int kSide = 8;  ///< cells along a brick's edge

  glm::ivec3 count{0};        ///< bricks along x, y, z
  std::vector<double> least;  ///< x fastest
  std::vector<double> greatest;

  std::size_t index(const glm::ivec3& brick) const noexcept {
    return static_cast<std::size_t>(brick.x) +
           static_cast<std::size_t>(count.x) *
               (static_cast<std::size_t>(brick.y) +
                static_cast<std::size_t>(count.y) * static_cast<std::size_t>(brick.z));
  }
};

/// @param volume  any; an axis of one sample counts as one cell
VolumeBricks make_volume_bricks(const Volume& volume);

/// Cells along each axis: one fewer than samples, but at least one.
glm::i64vec3 cell_count(const glm::i64vec3& dims) noexcept;

}  // namespace nacre

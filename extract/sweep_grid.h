#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

#include "core/volume.h"

namespace nacre {

/// A volume's lattice as the sweep sees it: at least two samples along every axis.
///
/// An axis of one sample, which spans one spacing and is constant, becomes two equal samples half a
/// spacing to either side: a stride of 0.
struct SweepGrid {
  std::array<std::size_t, 3> dims{};     ///< each at least 2
  std::array<std::size_t, 3> strides{};  ///< in samples
  glm::dvec3 center{0.0};                ///< the box's centre, in steps from the first sample
  std::array<glm::dvec3, 3> steps_mm{};  ///< from a sample to the next, along each axis
  /// How close to a sample a vertex may lie on a lattice edge, as a part of the edge.
  std::array<double, 3> margins{};
  bool left_handed = false;

  std::size_t sample_index(std::size_t x, std::size_t y, std::size_t z) const {
    return strides[0] * x + strides[1] * y + strides[2] * z;
  }

  /// Position relative to the box's centre, in mm. The translation never enters, so that a volume
  /// far from the origin loses nothing.
  glm::dvec3 position_mm(const glm::dvec3& index) const {
    const glm::dvec3 offset = index - center;
    return steps_mm[0] * offset.x + steps_mm[1] * offset.y + steps_mm[2] * offset.z;
  }
};

/// @throws Error  BadArgument for a singular matrix; Unsupported where float positions, relative to
///                the box's centre, could not tell the vertices of one cell apart (about a million
///                times finer spacing than the box is wide)
SweepGrid make_sweep_grid(const Volume& volume);

}  // namespace nacre

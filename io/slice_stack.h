#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "io/volume_read_report.h"

namespace nacre {

/// Where a slice lies: its first sample, the directions of x and y, and the spacing along them.
struct SliceFrame {
  glm::dvec3 position{0.0};     ///< LPS mm
  glm::dvec3 x_direction{0.0};  ///< of about unit length, like the next
  glm::dvec3 y_direction{0.0};
  glm::dvec2 spacing_mm{0.0};  ///< positive
  double thickness_mm = 0.0;   ///< of the slice; asked only where it is alone. 0: not known
};

/// Slices in order, as one grid.
struct SliceStack {
  std::vector<std::size_t> order;  ///< indices of the slices, along x cross y
  glm::dmat4 world_from_voxel{1.0};
};

/// Makes a grid of parallel slices from their positions alone.
///
/// Slices are ordered along their normal; the grid's third column is the way from the first
/// position to the last over the number of steps, so that a tilted gantry becomes an exact shear.
/// See docs/decisions/002: positions that stray from that are warned of above a thousandth of the
/// slice distance (a hundredth of a pixel sideways), and refused above a tenth.
///
/// @param path    of the series, for messages
/// @throws Error  BadFile if slices differ in orientation or spacing, share a position, miss one
///                between them, or do not lie along a line
SliceStack stack_slices(const std::filesystem::path& path, std::span<const SliceFrame> slices,
                        VolumeReadReport& report);

}  // namespace nacre

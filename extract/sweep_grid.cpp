#include "extract/sweep_grid.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/volume_geometry.h"

namespace nacre {
namespace {

/// Least margin: invisible in any picture, and far above the rounding of a usual volume.
constexpr double kLeastMargin = 1.0 / 4096;
/// Margins above this would bend the surface.
constexpr double kLargestMargin = 1.0 / 8;
/// A vertex and the sample it is kept from are at least this many roundings apart: enough for three
/// vertices around one sample to span a triangle after rounding.
constexpr double kRoundings = 8.0;
/// Columns closer to a plane than this are no lattice.
constexpr double kLeastHandedness = 1e-6;

/// Largest distance between neighbouring floats among the positions' coordinates, per coordinate.
glm::dvec3 rounding_mm(const SweepGrid& grid) {
  glm::dvec3 largest(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3& step = grid.steps_mm[static_cast<std::size_t>(axis)];
    for (int c = 0; c < 3; ++c) largest[c] += std::abs(step[c]) * grid.center[axis];
  }
  return largest * static_cast<double>(std::numeric_limits<float>::epsilon());
}

/// The least part of a step that still moves one of the coordinates by several roundings.
double margin_of(const glm::dvec3& step_mm, const glm::dvec3& rounding) {
  double margin = std::numeric_limits<double>::infinity();
  for (int c = 0; c < 3; ++c) {
    if (step_mm[c] == 0.0) continue;
    margin = std::min(margin, kRoundings * rounding[c] / std::abs(step_mm[c]));
  }
  return std::max(margin, kLeastMargin);
}

}  // namespace

SweepGrid make_sweep_grid(const Volume& volume) {
  SweepGrid grid;
  std::size_t stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const auto samples = static_cast<std::size_t>(volume.dims[axis]);
    grid.dims[a] = std::max<std::size_t>(samples, 2);
    grid.strides[a] = samples > 1 ? stride : 0;
    grid.center[axis] = 0.5 * static_cast<double>(grid.dims[a] - 1);
    grid.steps_mm[a] = glm::dvec3(volume.world_from_voxel[axis]);
    stride *= samples;
  }
  const double hand = handedness(volume.world_from_voxel);
  if (!(std::abs(hand) > kLeastHandedness)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("volume's world_from_voxel: found unit cell {} of its edges' product, "
                            "expected a regular matrix",
                            hand));
  }
  grid.left_handed = hand < 0.0;
  const glm::dvec3 rounding = rounding_mm(grid);
  for (std::size_t a = 0; a < 3; ++a) {
    grid.margins[a] = margin_of(grid.steps_mm[a], rounding);
    if (grid.margins[a] <= kLargestMargin) continue;
    throw Error(ErrorCode::Unsupported,
                fmt::format("volume of {} x {} x {} samples: its spacing along axis {} is too fine "
                            "for float positions",
                            volume.dims.x, volume.dims.y, volume.dims.z, "xyz"[a]));
  }
  return grid;
}

}  // namespace nacre

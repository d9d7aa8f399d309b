#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/shell_set.h"

namespace nacre {

struct GridOptions {
  /// Bits of the grid, 1 to 23; 0 chooses the fewest from 12 up whose step is small enough.
  int bits = 0;
  /// Largest step as a part of the smallest spacing.
  double largest_step_spacings = 1.0 / 64.0;
};

struct GridChoice {
  QuantizationGrid grid;
  double step_mm = 0.0;
  /// The step as a part of the volume's smallest spacing.
  double step_spacings = 0.0;
  /// The step is larger than asked for: floats have no more bits (or `GridOptions::bits` are few).
  bool is_coarse = false;
};

/// The grid for the shells of a volume: a cube around the volume's box, relative to its centre.
///
/// It does not depend on the shells, so that one added later lies on the same grid. The step is
/// m * 2^e with a short integer m (see `is_exact` in core/quantization_grid.h), the largest such
/// that is small enough; a larger grid than needed costs nothing, since compressed sizes follow the
/// step.
///
/// @throws Error  BadArgument for bits outside 1 to 23; Unsupported if the box's size or the step
///                are outside the range of floats
GridChoice choose_grid(const glm::i64vec3& dims, const glm::dmat4& world_from_voxel,
                       const GridOptions& options = {});

}  // namespace nacre

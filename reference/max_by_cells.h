#pragma once

#include "core/camera.h"
#include "core/picture.h"
#include "core/progress.h"
#include "reference/bright_bricks.h"
#include "reference/cell_kernel.h"
#include "reference/cued_emission.h"
#include "reference/tool_rays.h"
#include "reference/walk_field.h"

namespace nacre {

/// What a maximum picture by cells is made of; all outlive the call.
struct MaxByCells {
  const WalkField* field;
  const BrightBricks* bright;  ///< of the field
  const CuedEmission* emission;
  CellKernel kernel = cell_kernel_for(best_instruction_set());
};

/// max { beta(p) T(value) } along the ray of each pixel, exactly as `ExactWalk::max_emission`, but
/// cell by cell instead of ray by ray: the order does not matter to a maximum, so that the
/// brightest bricks are drawn first, and what is not brighter than all that is seen already where
/// it lies is never looked at again. The rays of neighbouring pixels go through a cell together.
///
/// Each ray's part in a cell, its cubic and its maximum are those of the walk; only the order is
/// another (the last bit may differ). Many times faster where little is bright.
///
/// @param tools  none (null), or what cuts rays off and is put into the picture's layer
Picture max_picture_by_cells(const MaxByCells& scene, const Camera& camera, const DepthCue& cue,
                             const Slab& slab, const ToolRays* tools,
                             const ProgressCallback& progress);

}  // namespace nacre

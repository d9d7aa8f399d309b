#pragma once

#include <vector>

#include "core/camera.h"
#include "core/image.h"
#include "core/picture.h"
#include "core/progress.h"
#include "reference/exact_walk.h"
#include "reference/layer_walk.h"
#include "reference/tool_rays.h"

namespace nacre {

/// What an exact picture shows.
struct ExactPictureOptions {
  PictureMode mode = PictureMode::Max;
  DepthCue cue = {};
  Slab slab = {};
  std::vector<ShownLevel> levels = {};  ///< of count, iso and ideal shells: at least one
  const ToolRays* tools = nullptr;      ///< none, or what outlives the call
};

/// The exact picture of a volume: one ray through each pixel's centre.
///
/// - max: the largest cued emission along the ray;
/// - sum: the integral of the cued emission, emission * mm;
/// - count: the sum of r_k over the crossings of the ideal shells (no cue: [H96] section 2.1);
/// - iso: the first crossing of an ideal shell, `headlight` of the field's exact normal times beta
///   there. A surface met from inside is turned away from the light.
///
/// The volume shows only in front of the nearest tool, which slabs do not cut. Pixels that show
/// nothing are 0. Uses all cores; the same bytes for any number of threads.
///
/// @throws Error  BadArgument for a bad cue, an empty slab, or missing or bad levels
Picture exact_picture(const ExactWalk& walk, const Camera& camera,
                      const ExactPictureOptions& options = {},
                      const ProgressCallback& progress = {});

/// What ideal shells at the options' levels would show: as `exact_picture`, but with the
/// piecewise-constant emission of the layers in max and sum.
///
/// - max: the largest r_k beta over points inside shell k, [H96] eq. 4;
/// - sum: the integral of beta r_n, n the layer, [H96] eq. 2.
///
/// A shell that is not among the levels leaves its layer to the one before it.
Picture ideal_picture(const ExactWalk& walk, const Camera& camera,
                      const ExactPictureOptions& options, const ProgressCallback& progress = {});

}  // namespace nacre

#pragma once

#include <memory>

#include "core/camera.h"
#include "core/instruction_set.h"
#include "core/picture.h"
#include "core/progress.h"
#include "reference/exact_walk.h"
#include "reference/tool_rays.h"

namespace nacre {

class CastBricks;

/// What a sampled maximum shows, and how.
struct SampledMaximumOptions {
  int per_cell = 2;  ///< planes of samples a cell, 1 to `kMostSamplesPerCell` (sample_kernel.h)
  DepthCue cue = {};
  Slab slab = {};
  const ToolRays* tools = nullptr;                       ///< none, or what outlives the call
  InstructionSet instructions = best_instruction_set();  ///< the picture does not depend on it
};

/// The greatest cued emission among samples along the ray through each pixel's centre: a maximum
/// projection by ray casting, as volume renderers have it. Never above what `exact_picture` finds
/// but for rounding to floats, and nearer to it the closer samples lie: twice as many about halve
/// the error (6 to 9 dB on angiograms).
///
/// A ray is sampled, trilinearly, where it crosses the planes of voxels across the axis that it is
/// steepest to, on planes evenly between them, and where it enters and leaves the volume's box, a
/// slab, or ends at a tool. A trilinear field has its kinks, and with them many of its maxima, on
/// planes of voxels, so that few samples tell much (docs/decisions/029-sampled-maxima.md).
///
/// Bricks of voxels are drawn the brightest first, as `max_picture_by_cells` does. Places are
/// floats, which comes to an emission of some 1e-7 times the cells along the volume times the
/// steepest slope a cell. The exact picture is drawn instead where that could exceed 0.01 (windows
/// a hundredth of the samples' range wide, volumes of 1e5 voxels, maps with a step), where the rays
/// of 32 x 32 pixels have no axis that all are steep to (a wide view in few pixels), and for cues
/// of 1e30 and more. The same bytes for any number of threads and any instructions.
class SampledMaximum {
 public:
  /// Reads what is bright once, on all cores.
  /// @param walk  outlives this object
  explicit SampledMaximum(const ExactWalk& walk);
  ~SampledMaximum();
  SampledMaximum(SampledMaximum&&) noexcept;

  /// Whether `picture` is one of samples: else it is the exact one.
  bool takes_samples(const Camera& camera, const DepthCue& cue = {}) const;

  /// @throws Error  BadArgument for a bad cue, an empty slab, or samples out of range; Unsupported
  ///                for samples under a cue with an emission map of more than one piece
  Picture picture(const Camera& camera, const SampledMaximumOptions& options = {},
                  const ProgressCallback& progress = {}) const;

 private:
  const ExactWalk* walk_;
  std::unique_ptr<const CastBricks> bricks_;  ///< null: floats do not do
};

}  // namespace nacre

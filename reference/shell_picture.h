#pragma once

#include <cstdint>
#include <vector>

#include "core/camera.h"
#include "core/image.h"
#include "core/picture.h"
#include "core/progress.h"
#include "core/shell_set.h"
#include "reference/tool_rays.h"

namespace nacre {

/// What an exact picture of shells shows.
struct ShellPictureOptions {
  PictureMode mode = PictureMode::Max;
  DepthCue cue = {};
  Slab slab = {};
  /// Indices of shells that are not shown, from 0; any order. Their layers show the previous shown
  /// shell's representative.
  std::vector<std::uint32_t> hidden = {};
  const ToolRays* tools = nullptr;  ///< what the volume is shown in front of; may be none
};

/// The exact picture of a shell set's surfaces: one ray through each pixel's centre, in double,
/// against the very triangles (`crossing`: no ray slips through an edge or counts it twice).
///
/// Along a ray, between where it starts (the slab's near plane, the eye) and ends (its far plane, a
/// tool), with beta the cue at a crossing's depth (docs/derivations.md, R2):
///
/// - max:   the largest beta r_k over crossings of shown shells, [H96] eq. 4; where it starts
/// inside
///          n shells also r_n beta at the start; or, if beta falls towards the eye, at the end;
/// - sum:   the integral of beta times the piecewise-constant emission, emission * mm, [H96] eq. 2;
/// - count: each crossing adds r_k, [H96] section 2.1;
/// - iso:   the headlight on the first crossing, with smooth normals (angle-weighted at vertices,
///          interpolated), times beta.
///
/// A ray that misses the box of the set's volume, where one is stated, shows nothing but for iso:
/// caps lie on their grid, up to about a step beyond it (docs/decisions/028-exact-borders.md).
///
/// The surfaces are taken as they are; for sums, and rays that start inside, they should be closed.
/// Slabs do not cut tools. Uses all cores, a few bytes a triangle and about 120 bytes a pixel (of
/// half a million at a time); the same bytes for any number of threads.
///
/// @throws Error  BadArgument for an empty slab, a cue that is negative or not finite in the
///                sphere, or a hidden shell that does not exist
Picture shell_picture(const ShellSet& set, const Camera& camera,
                      const ShellPictureOptions& options = {},
                      const ProgressCallback& progress = {});

}  // namespace nacre

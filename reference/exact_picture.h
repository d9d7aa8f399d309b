#pragma once

#include "core/camera.h"
#include "core/image.h"
#include "core/picture.h"
#include "core/progress.h"
#include "reference/exact_walk.h"

namespace nacre {

/// What an exact picture shows.
struct ExactPictureOptions {
  PictureMode mode = PictureMode::Max;
  Slab slab = {};
};

/// The exact picture of a volume: one ray through each pixel's centre.
///
/// max: the emission's maximum along the ray, in [0, 1]. sum: its integral, emission * mm. Pixels
/// whose ray misses the volume are 0. Uses all cores; the same bytes for any number of threads.
///
/// @throws Error  BadArgument for a mode other than Max and Sum, or an empty slab
Image exact_picture(const ExactWalk& walk, const Camera& camera,
                    const ExactPictureOptions& options = {}, const ProgressCallback& progress = {});

}  // namespace nacre

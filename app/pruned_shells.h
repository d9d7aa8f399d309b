#pragma once

#include <span>

#include "app/command.h"
#include "core/camera.h"
#include "core/shell_set.h"
#include "render/render_options.h"

namespace nacre {

/// Sees to it that what was pruned from a set is not missed silently.
///
/// A set without its cavities (`nacre build --purpose max`) shows maximum projections from outside
/// the volume. Slabs and eyes within the volume are warned of; so is a cue that falls towards the
/// eye with tools, which cut the ray in a cavity.
///
/// @throws Error  Unsupported for sums and counts of such a set
void check_pruning(const ShellSet& set, const RenderOptions& options,
                   std::span<const Camera> cameras, Reporter& reporter);

}  // namespace nacre

#include "app/pruned_shells.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/error.h"

namespace nacre {
namespace {

bool is_cut(const Slab& slab) { return std::isfinite(slab.near_mm) || std::isfinite(slab.far_mm); }

bool is_within_volume(const Camera& camera) {
  return camera.perspective &&
         glm::distance(eye_mm(camera), camera.sphere.center_mm) < camera.sphere.radius_mm;
}

}  // namespace

void check_pruning(const ShellSet& set, const RenderOptions& options,
                   std::span<const Camera> cameras, Reporter& reporter) {
  const std::size_t inner = set.pruned.inner.components;
  if (inner == 0) return;
  if (options.mode == PictureMode::Sum || options.mode == PictureMode::Count) {
    throw Error(
        ErrorCode::Unsupported,
        fmt::format("shell set: found one whose {} inner components were left out (--purpose "
                    "max), expected one with all of them (--purpose all) for sums and counts",
                    inner));
  }
  const bool seen_from_within = is_cut(options.slab) ||
                                std::any_of(cameras.begin(), cameras.end(), is_within_volume) ||
                                options.cue.a < 0.0;
  if (seen_from_within) {
    reporter.warn(
        fmt::format("{} inner components (cavities) were left out of this set (--purpose max); "
                    "slabs, eyes within "
                    "the volume, and tools under a falling cue would show them",
                    inner));
  }
}

}  // namespace nacre

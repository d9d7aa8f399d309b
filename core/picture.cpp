#include "core/picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/error.h"

namespace nacre {

void check_cue(const DepthCue& cue) {
  const double at_far = beta(cue, 0.0);
  const double at_near = beta(cue, 1.0);
  if (!std::isfinite(at_far) || !std::isfinite(at_near) || at_far < 0.0 || at_near < 0.0) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("depth cue: found {} at the far and {} at the near end, expected "
                            "finite numbers of 0 or more",
                            at_far, at_near));
  }
}

void check_slab(const Slab& slab) {
  if (!(slab.near_mm < slab.far_mm)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("slab: found {},{}, expected NEAR < FAR", slab.near_mm, slab.far_mm));
  }
}

RayInterval visible_interval(const Camera& camera, const Ray& ray, const Slab& slab) {
  // Depth along the viewing direction rises linearly with t: depth = start + advance * t.
  const double start = slab_depth_mm(camera, ray.origin_mm);
  const double advance = glm::dot(ray.direction, camera.forward);
  RayInterval interval{(slab.near_mm - start) / advance, (slab.far_mm - start) / advance};
  if (camera.perspective) interval.t_begin_mm = std::max(interval.t_begin_mm, 0.0);
  return interval;
}

}  // namespace nacre

#include "reference/shell_pixels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace nacre {
namespace {

bool may_be_inside(const ShellBounds& bounds, const glm::dvec3& p_mm) {
  const glm::dvec3 hair = 1e-9 * (1.0 + glm::abs(p_mm));
  for (const int axis : {0, 1, 2}) {
    if (p_mm[axis] < bounds.lo_mm[axis] - hair[axis]) return false;
    if (p_mm[axis] > bounds.hi_mm[axis] + hair[axis]) return false;
  }
  return true;
}

/// Where the cue is largest among points at which the ray may be inside shells already (or still):
/// at its start, or, for a cue that falls towards the eye, at its end.
double brightest_end_mm(const DepthCue& cue, const RayInterval& interval) {
  return cue.a < 0.0 ? interval.t_end_mm : interval.t_begin_mm;
}

void set_cue(const Camera& camera, const DepthCue& cue, const Ray& ray, ShellPixel& pixel) {
  const double advance = glm::dot(ray.direction, camera.forward);
  pixel.beta_at_origin = beta(cue, depth_z(camera, ray.origin_mm));
  pixel.beta_per_mm = -cue.a * advance / (2.0 * camera.sphere.radius_mm);
  const double begin = pixel.interval.t_begin_mm;
  const double at_sphere =
      (-camera.sphere.radius_mm - slab_depth_mm(camera, ray.origin_mm)) / advance;
  pixel.zero_mm = std::isfinite(begin) ? begin : at_sphere;
}

}  // namespace

ShellPixels::ShellPixels(const Camera& camera, const DepthCue& cue, const Slab& slab,
                         const ShellBounds& bounds, const ToolRays* tools, ToolLayer* layer)
    : camera_(camera), cue_(cue), slab_(slab), bounds_(bounds), tools_(tools), layer_(layer) {}

void ShellPixels::begin(int first_row, int end_row) {
  first_row_ = first_row;
  const auto count =
      static_cast<std::size_t>(camera_.size.x) * static_cast<std::size_t>(end_row - first_row);
  made_.assign(count, 0);
  if (count > count_) {
    slots_ = std::make_unique_for_overwrite<Slot[]>(count);  // NOLINT(modernize-avoid-c-arrays)
    count_ = count;
  }
  if (layer_ == nullptr) return;
  tbb::parallel_for(first_row, end_row, [&](int y) {
    for (int x = 0; x < camera_.size.x; ++x) make(x, y);
  });
}

void ShellPixels::make(int x, int y) {
  const Ray ray = picture_ray(camera_, x + 0.5, y + 0.5);
  ShellPixel pixel(ray);
  pixel.interval = visible_interval(camera_, ray, slab_);
  if (layer_ != nullptr) {
    pixel.interval.t_end_mm = std::min(pixel.interval.t_end_mm,
                                       draw_tool_pixel(*tools_, camera_, cue_, ray, x, y, *layer_));
  }
  set_cue(camera_, cue_, ray, pixel);
  const double t = brightest_end_mm(cue_, pixel.interval);
  if (std::isfinite(t) && may_be_inside(bounds_, ray.origin_mm + t * ray.direction)) {
    pixel.counted_from_mm = t;
  }
  const std::size_t i = index(x, y);
  std::construct_at(&slots_[i].pixel, pixel);
  made_[i] = 1;
}

}  // namespace nacre

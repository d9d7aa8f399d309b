#include "reference/tile_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace nacre {

PixelLines::PixelLines(const WalkField& field, const Camera& camera, const Slab& slab)
    : field_(field),
      camera_(camera),
      slab_(slab),
      shows_always_(field.emission_of_field.knots().front().emission > 0.0) {
  if (camera.perspective) return;
  const Ray corner = picture_ray(camera, 0.0, 0.0);
  const RayInterval visible = visible_interval(camera, corner, slab);
  const double pixel_mm = 2.0 * camera.half_extent / std::min(camera.size.x, camera.size.y);
  first_ = field.frame.line(corner);
  visible_ = {visible.t_begin_mm, visible.t_end_mm};
  right_ = field.frame.cell_from_world * (pixel_mm * camera.right);
  down_ = field.frame.cell_from_world * (-pixel_mm * camera.up);
  direction_mm_ = camera.forward;
  const glm::dvec3 steepness = glm::abs(first_.direction);
  is_plain_ = !shows_always_ &&
              std::min({steepness.x, steepness.y, steepness.z}) > slope_along_planes(steepness);
}

std::optional<PixelLine> PixelLines::entered(int x, int y) const {
  const Ray ray = picture_ray(camera_, x + 0.5, y + 0.5);
  const auto line = field_.enter(ray, visible_interval(camera_, ray, slab_));
  if (!line) return std::nullopt;
  return PixelLine{line->line, line->interval, line->t_begin_mm, ray.direction};
}

std::optional<PixelLine> PixelLines::any(int x, int y) const {
  if (shows_always_) return entered(x, y);
  PixelLine ray{first_, visible_, 0.0, direction_mm_};
  if (camera_.perspective) {
    // From the point beside the volume's centre, so that a far eye costs no digits.
    Ray seen = picture_ray(camera_, x + 0.5, y + 0.5);
    const RayInterval visible = visible_interval(camera_, seen, slab_);
    ray.t_shift_mm = glm::dot(field_.frame.center_mm - seen.origin_mm, seen.direction);
    seen.origin_mm += ray.t_shift_mm * seen.direction;
    ray.line = field_.frame.line(seen);
    ray.direction_mm = seen.direction;
    ray.visible = {visible.t_begin_mm - ray.t_shift_mm, visible.t_end_mm - ray.t_shift_mm};
  } else {
    ray.line = line(x, y);
  }
  const glm::dvec3 steepness = glm::abs(ray.line.direction);
  const double along = slope_along_planes(steepness);
  for (int axis = 0; axis < 3; ++axis) {
    if (steepness[axis] > along) continue;
    // Well inside, a ray along an axis is a ray as any other.
    const double origin = ray.line.origin[axis];
    const auto end = static_cast<double>(field_.cells[axis]);
    const bool well_inside = origin > 1e-3 && origin < end - 1e-3;
    if (steepness[axis] != 0.0 || !well_inside) return entered(x, y);
  }
  return ray;
}

TileRays::TileRays() : figures_(kColumns * kRays) {}

void TileRays::clear() {
  std::fill(column(kBest), column(kBest) + kRays, std::numeric_limits<double>::infinity());
  any_slack_ = false;
}

void TileRays::put(int x, int y, const PixelLine& ray, double best) {
  const std::size_t i = index(x, y);
  for (int axis = 0; axis < 3; ++axis) {
    const double direction = ray.line.direction[axis];
    const bool never = direction == 0.0;
    any_slack_ = any_slack_ || never;
    column(kOrigin + axis)[i] = ray.line.origin[axis];
    column(kDirection + axis)[i] = direction;
    column(kInverse + axis)[i] = never ? LaneRays::kNever : 1.0 / direction;
    column(kSlack + axis)[i] = never ? LaneRays::kSlack : 0.0;
  }
  column(kBegin)[i] = ray.visible.t_enter;
  column(kEnd)[i] = ray.visible.t_exit;
  column(kBest)[i] = best;
}

LaneRays TileRays::lanes() {
  const auto three = [&](int first) {
    return std::array{column(first), column(first + 1), column(first + 2)};
  };
  const auto [ox, oy, oz] = three(kOrigin);
  const auto [dx, dy, dz] = three(kDirection);
  const auto [ix, iy, iz] = three(kInverse);
  const auto [sx, sy, sz] =
      any_slack_ ? three(kSlack) : std::array<double*, 3>{nullptr, nullptr, nullptr};
  return {{ox, oy, oz}, {dx, dy, dz},  {ix, iy, iz},    {sx, sy, sz},      column(kBegin),
          column(kEnd), column(kBest), column(kBetaAt), column(kBetaRise), kStride};
}

}  // namespace nacre

#include "reference/tile_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace nacre {
namespace {

/// Cells from a border plane, within which a ray along it may be in it.
constexpr double kWellInside = 1e-3;

}  // namespace

PixelLines::PixelLines(const WalkField& field, const Camera& camera, const Slab& slab)
    : field_(field),
      camera_(camera),
      slab_(slab),
      shows_always_(field.emission_of_field.knots().front().emission > 0.0) {
  if (camera.perspective) return;
  const Ray corner = picture_ray(camera, 0.0, 0.0);
  const RayInterval visible = visible_interval(camera, corner, slab);
  const double pixel_mm = 2.0 * camera.half_extent / std::min(camera.size.x, camera.size.y);
  parallel_.corner = field.frame.line(corner);
  visible_ = {visible.t_begin_mm, visible.t_end_mm};
  parallel_.right = field.frame.cell_from_world * (pixel_mm * camera.right);
  parallel_.down = field.frame.cell_from_world * (-pixel_mm * camera.up);
  direction_mm_ = camera.forward;
  const glm::dvec3 steepness = glm::abs(parallel_.corner.direction);
  const double along = slope_along_planes(steepness);
  is_plain_ = !shows_always_;
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_along = steepness[axis] == 0.0;
    is_plain_ = is_plain_ && (is_along || steepness[axis] > along);
    least_[axis] = is_along ? kWellInside : -std::numeric_limits<double>::infinity();
    most_[axis] = is_along ? static_cast<double>(field.cells[axis]) - kWellInside
                           : std::numeric_limits<double>::infinity();
  }
}

bool PixelLines::find_entered(int x, int y, PixelLine& ray) const {
  const Ray seen = picture_ray(camera_, x + 0.5, y + 0.5);
  const auto line = field_.enter(seen, visible_interval(camera_, seen, slab_));
  if (!line) return false;
  ray = {line->line, line->interval, line->t_begin_mm, seen.direction};
  return true;
}

bool PixelLines::find_any(int x, int y, PixelLine& ray) const {
  if (shows_always_) return find_entered(x, y, ray);
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
    put_line(x, y, ray.line);
    ray.visible = visible_;
    ray.t_shift_mm = 0.0;
    ray.direction_mm = direction_mm_;
  }
  const glm::dvec3 steepness = glm::abs(ray.line.direction);
  const double along = slope_along_planes(steepness);
  for (int axis = 0; axis < 3; ++axis) {
    if (steepness[axis] > along) continue;
    // Well inside, a ray along an axis is a ray as any other.
    const double origin = ray.line.origin[axis];
    const auto end = static_cast<double>(field_.cells[axis]);
    if (steepness[axis] == 0.0 && (origin < -kWellInside || origin > end + kWellInside)) {
      return false;
    }
    const bool well_inside = origin > kWellInside && origin < end - kWellInside;
    if (steepness[axis] != 0.0 || !well_inside) return find_entered(x, y, ray);
  }
  return true;
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

#include "casting/cast_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace nacre {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

CastAxes axes_across(int plane) { return {plane == 0 ? 1 : 0, plane == 2 ? 1 : 2, plane}; }

/// Places on the planes across an axis, linear in the plane's number.
struct PlaneLine {
  double u;  ///< on plane 0
  double v;
  double du;
  double dv;
};

PlaneLine across_planes(const CellLine& line, const CastAxes& axes) {
  const double per_plane = 1.0 / line.direction[axes.plane];
  const double du = line.direction[axes.u] * per_plane;
  const double dv = line.direction[axes.v] * per_plane;
  const double plane = line.origin[axes.plane];
  return {line.origin[axes.u] - plane * du, line.origin[axes.v] - plane * dv, du, dv};
}

}  // namespace

std::optional<CastAxes> steep_axes(const WalkField& field, const Camera& camera,
                                   const PixelRange& pixels) {
  constexpr double kSteep = 0.5;
  // Directions from one eye are linear in the pixel up to their length: corners bound the others.
  const glm::dvec2 first(pixels.first);
  const glm::dvec2 end(pixels.last + 1);
  std::array<glm::dvec3, 4> directions;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Ray ray = picture_ray(camera, i % 2 == 0 ? first.x : end.x, i < 2 ? first.y : end.y);
    const glm::dvec3 direction = field.frame.cell_from_world * ray.direction;
    const glm::dvec3 steepness = glm::abs(direction);
    directions[i] = direction / std::max({steepness.x, steepness.y, steepness.z});
  }
  int steepest = 0;
  double best = -1.0;
  for (int axis = 0; axis < 3; ++axis) {
    double least = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& direction : directions) {
      least = std::min(least, std::copysign(1.0, directions[0][axis]) * direction[axis]);
    }
    if (least > best) {
      best = least;
      steepest = axis;
    }
  }
  if (!(best >= kSteep)) return std::nullopt;
  return axes_across(steepest);
}

std::optional<std::vector<CastAxes>> axes_of_tiles(const WalkField& field, const Camera& camera) {
  std::vector<CastAxes> axes;
  glm::ivec2 first(0);
  for (first.y = 0; first.y < camera.size.y; first.y += BlockRays::kTile) {
    for (first.x = 0; first.x < camera.size.x; first.x += BlockRays::kTile) {
      if (!camera.perspective && !axes.empty()) {
        axes.push_back(axes.front());
        continue;
      }
      const PixelRange pixels{first, glm::min(first + BlockRays::kTile, camera.size) - 1};
      const auto found = steep_axes(field, camera, pixels);
      if (!found) return std::nullopt;
      axes.push_back(*found);
    }
  }
  return axes;
}

void CastRays::clear(const CastAxes& axes) {
  axes_ = axes;
  best_.fill(kInfinity);
  latest_first_ = -kInfinity;
  earliest_last_ = kInfinity;
}

void CastRays::put(int x, int y, const PixelLine& ray, float start) {
  const std::size_t i = index(x, y);
  const PlaneLine line = across_planes(ray.line, axes_);
  u_[i] = static_cast<float>(line.u);
  v_[i] = static_cast<float>(line.v);
  du_[i] = static_cast<float>(line.du);
  dv_[i] = static_cast<float>(line.dv);
  const double origin = ray.line.origin[axes_.plane];
  const double direction = ray.line.direction[axes_.plane];
  const auto enter = static_cast<float>(origin + ray.visible.t_enter * direction);
  const auto exit = static_cast<float>(origin + ray.visible.t_exit * direction);
  first_plane_[i] = std::min(enter, exit);
  last_plane_[i] = std::max(enter, exit);
  latest_first_ = std::max(latest_first_, first_plane_[i]);
  earliest_last_ = std::min(earliest_last_, last_plane_[i]);
  best_[i] = start;
}

void CastRays::put_parallel(const ParallelLines& lines, const PixelRange& tile) {
  const PlaneLine corner = across_planes(lines.corner, axes_);
  const auto step = [&](const glm::dvec3& way) {
    return glm::dvec2(way[axes_.u] - way[axes_.plane] * corner.du,
                      way[axes_.v] - way[axes_.plane] * corner.dv);
  };
  const glm::dvec2 right = step(lines.right);
  const glm::dvec2 down = step(lines.down);
  du_.fill(static_cast<float>(corner.du));
  dv_.fill(static_cast<float>(corner.dv));
  for (int y = tile.first.y; y <= tile.last.y; ++y) {
    const double u = corner.u + (y + 0.5) * down.x;
    const double v = corner.v + (y + 0.5) * down.y;
    for (int x = tile.first.x; x <= tile.last.x; ++x) {
      const std::size_t i = index(x - tile.first.x, y - tile.first.y);
      u_[i] = static_cast<float>(u + (x + 0.5) * right.x);
      v_[i] = static_cast<float>(v + (x + 0.5) * right.y);
      best_[i] = 0.0F;
    }
  }
}

BlockRays CastRays::lanes(double planes) {
  const bool cut = latest_first_ > 0.0F || static_cast<double>(earliest_last_) < planes;
  return {u_.data(),
          v_.data(),
          du_.data(),
          dv_.data(),
          cut ? first_plane_.data() : nullptr,
          cut ? last_plane_.data() : nullptr,
          best_.data()};
}

}  // namespace nacre

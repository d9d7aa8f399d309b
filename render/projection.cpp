#include "render/projection.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace nacre {
namespace {

constexpr double kNearFraction = 1e-5;

/// The affine function dot(normal, p) + offset of a local point p, as a row of a matrix.
glm::dvec4 row(const glm::dvec3& normal, double offset) { return {normal, offset}; }

glm::dmat4 from_rows(const std::array<glm::dvec4, 4>& rows) {
  glm::dmat4 matrix;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) matrix[c][r] = rows[static_cast<std::size_t>(r)][c];
  }
  return matrix;
}

/// Half the picture's width or height in the units of `Camera::half_extent`.
double half_side(const Camera& camera, int side) {
  return camera.half_extent * side / std::min(camera.size.x, camera.size.y);
}

/// Clip coordinates of the whole picture as rows x (right), y (down), z, w.
std::array<glm::dvec4, 4> picture_rows(const Camera& camera, const glm::dvec3& origin_mm) {
  const glm::dvec3 from = camera.perspective ? eye_mm(camera) : camera.target_mm;
  const glm::dvec3 to_origin = origin_mm - from;
  const auto along = [&](const glm::dvec3& axis) { return row(axis, glm::dot(axis, to_origin)); };
  const glm::dvec4 x = along(camera.right) / half_side(camera, camera.size.x);
  const glm::dvec4 y = -along(camera.up) / half_side(camera, camera.size.y);
  if (camera.perspective) {
    const glm::dvec4 w = along(camera.forward);
    return {x, y, w - row({}, 2.0 * near_plane_mm(camera)), w};
  }
  const double radius = camera.sphere.radius_mm;
  const double depth_mm = glm::dot(camera.forward, origin_mm - camera.sphere.center_mm);
  return {x, y, row(camera.forward / radius, depth_mm / radius), row({}, 1.0)};
}

std::array<glm::dvec3, 8> corners(const Box& box) {
  std::array<glm::dvec3, 8> result;
  for (std::size_t i = 0; i < 8; ++i) {
    result[i] = {(i & 1U) != 0 ? box.hi.x : box.lo.x, (i & 2U) != 0 ? box.hi.y : box.lo.y,
                 (i & 4U) != 0 ? box.hi.z : box.lo.z};
  }
  return result;
}

/// Values of an affine function all over the box.
Interval range_on(const Box& box, const glm::dvec4& function) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Interval range{infinity, -infinity};
  for (const glm::dvec3& p : corners(box)) {
    const double value = glm::dot(function, glm::dvec4(p, 1.0));
    range = {std::min(range.lo, value), std::max(range.hi, value)};
  }
  return range;
}

/// Whether the affine function is negative all over the box.
bool negative_on(const Box& box, const glm::dvec4& function) {
  return range_on(box, function).hi < 0.0;
}

/// Where in the picture the box lies along one of its axes, from -1 to 1; all of the axis if part
/// of the box is before the near plane.
Interval extent_on(const Camera& camera, const std::array<glm::dvec4, 4>& rows, std::size_t axis,
                   const Box& box) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const glm::dvec4& w = rows[3];
  if (camera.perspective && range_on(box, w).lo <= near_plane_mm(camera)) {
    return {-infinity, infinity};
  }
  Interval extent{infinity, -infinity};
  for (const glm::dvec3& p : corners(box)) {
    const glm::dvec4 point(p, 1.0);
    const double place = glm::dot(rows[axis], point) / glm::dot(w, point);
    extent = {std::min(extent.lo, place), std::max(extent.hi, place)};
  }
  return extent;
}

bool overlap(const Interval& a, const Interval& b, double margin) {
  return a.lo <= b.hi + margin && b.lo <= a.hi + margin;
}

}  // namespace

double near_plane_mm(const Camera& camera) { return kNearFraction * camera.sphere.radius_mm; }

glm::dmat4 clip_from_local(const Camera& camera, const glm::dvec3& origin_mm,
                           const PixelRect& rect) {
  std::array<glm::dvec4, 4> rows = picture_rows(camera, origin_mm);
  // Pixel = (clip / w + 1) * side / 2; the same pixel counted from the rectangle's corner.
  const auto to_rect = [&](const glm::dvec4& clip, int side, int first, int length) {
    return (clip * static_cast<double>(side) -
            rows[3] * static_cast<double>(2 * first + length - side)) /
           static_cast<double>(length);
  };
  rows[0] = to_rect(rows[0], camera.size.x, rect.x, rect.width);
  rows[1] = to_rect(rows[1], camera.size.y, rect.y, rect.height);
  return from_rows(rows);
}

bool outside_view(const Camera& camera, const glm::dvec3& origin_mm, const Box& box) {
  const std::array<glm::dvec4, 4> rows = picture_rows(camera, origin_mm);
  const glm::dvec4& w = rows[3];
  const glm::dvec2 pixel = 2.0 / glm::dvec2(camera.size);
  if (camera.perspective && negative_on(box, w - row({}, near_plane_mm(camera)))) return true;
  return negative_on(box, w * (1.0 + pixel.x) - rows[0]) ||
         negative_on(box, w * (1.0 + pixel.x) + rows[0]) ||
         negative_on(box, w * (1.0 + pixel.y) - rows[1]) ||
         negative_on(box, w * (1.0 + pixel.y) + rows[1]);
}

glm::dvec4 view_depth_from_local(const Camera& camera, const glm::dvec3& origin_mm) {
  const glm::dvec3 from = camera.perspective ? eye_mm(camera) : camera.sphere.center_mm;
  return row(camera.forward, glm::dot(camera.forward, origin_mm - from));
}

double view_depth_of_slab(const Camera& camera, double slab_mm) {
  return camera.perspective ? slab_mm - slab_depth_mm(camera, eye_mm(camera)) : slab_mm;
}

Interval view_depths(const Camera& camera, const glm::dvec3& origin_mm, const Box& box) {
  return range_on(box, view_depth_from_local(camera, origin_mm));
}

bool may_hide(const Camera& camera, const glm::dvec3& origin_mm, const Box& front,
              const Box& behind) {
  if (view_depths(camera, origin_mm, front).lo > view_depths(camera, origin_mm, behind).hi) {
    return false;
  }
  const std::array<glm::dvec4, 4> rows = picture_rows(camera, origin_mm);
  const glm::dvec2 pixel = 2.0 / glm::dvec2(camera.size);
  return overlap(extent_on(camera, rows, 0, front), extent_on(camera, rows, 0, behind), pixel.x) &&
         overlap(extent_on(camera, rows, 1, front), extent_on(camera, rows, 1, behind), pixel.y);
}

}  // namespace nacre

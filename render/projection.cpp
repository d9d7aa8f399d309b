#include "render/projection.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

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

/// Whether the affine function is negative all over the box.
bool negative_on(const Box& box, const glm::dvec4& function) {
  const auto points = corners(box);
  return std::all_of(points.begin(), points.end(), [&](const glm::dvec3& p) {
    return glm::dot(function, glm::dvec4(p, 1.0)) < 0.0;
  });
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

bool beyond_near_plane(const Camera& camera, const glm::dvec3& origin_mm, const Box& box) {
  if (!camera.perspective) return true;
  const glm::dvec4 w = picture_rows(camera, origin_mm)[3];
  return negative_on(box, row({}, near_plane_mm(camera)) - w);
}

}  // namespace nacre

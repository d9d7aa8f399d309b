#include "core/volume_silhouette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "core/volume_geometry.h"

namespace nacre {
namespace {

// Of the sphere's radius: what of the box is nearer to a perspective eye is not looked at.
constexpr double kNearest = 1e-9;
// Rounding of a column, as a part of the picture's width.
constexpr double kHair = 1e-12;

/// The box's corners in the camera's frame (right, up, forward), mm: from the eye in perspective,
/// from the target else. By way of the box's centre, so that a far-away origin costs no digits.
std::array<glm::dvec3, 8> corners_seen(const Camera& camera, const glm::i64vec3& dims,
                                       const glm::dmat4& world_from_voxel) {
  const VoxelBox box = voxel_box(dims);
  const glm::dvec3 center_mm(world_from_voxel * glm::dvec4(0.5 * (box.lo + box.hi), 1.0));
  glm::dvec3 center = center_mm - camera.target_mm;
  if (camera.perspective) center += camera.eye_distance_mm * camera.forward;
  const glm::dmat3 axes(world_from_voxel);
  std::array<glm::dvec3, 8> corners;
  for (unsigned i = 0; i < corners.size(); ++i) {
    const glm::dvec3 side((i & 1U) != 0 ? 0.5 : -0.5, (i & 2U) != 0 ? 0.5 : -0.5,
                          (i & 4U) != 0 ? 0.5 : -0.5);
    const glm::dvec3 p = center + axes * (side * (box.hi - box.lo));
    corners[i] = {glm::dot(p, camera.right), glm::dot(p, camera.up), glm::dot(p, camera.forward)};
  }
  return corners;
}

/// Corners of what of the box is farther than `nearest` along the viewing direction.
std::vector<glm::dvec3> corners_before_eye(const std::array<glm::dvec3, 8>& corners,
                                           double nearest) {
  std::vector<glm::dvec3> kept;
  for (unsigned i = 0; i < corners.size(); ++i) {
    const glm::dvec3& a = corners[i];
    if (a.z >= nearest) kept.push_back(a);
    for (const unsigned bit : {1U, 2U, 4U}) {
      const glm::dvec3& b = corners[i ^ bit];
      if ((i & bit) != 0 || (a.z >= nearest) == (b.z >= nearest)) continue;
      const double s = (nearest - a.z) / (b.z - a.z);
      kept.push_back({glm::dvec2(a) + s * (glm::dvec2(b) - glm::dvec2(a)), nearest});
    }
  }
  return kept;
}

/// Where the corners lie in the picture, in pixels.
std::vector<glm::dvec2> in_picture(const Camera& camera, const std::vector<glm::dvec3>& corners) {
  const double shorter = std::min(camera.size.x, camera.size.y);
  const double pixels = 0.5 * shorter / camera.half_extent;
  std::vector<glm::dvec2> points;
  for (const glm::dvec3& p : corners) {
    const double scale = camera.perspective ? pixels / p.z : pixels;
    points.emplace_back(0.5 * camera.size.x + scale * p.x, 0.5 * camera.size.y - scale * p.y);
  }
  return points;
}

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The convex hull's corners in order (Andrew's monotone chain).
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
  if (points.empty()) return {};
  std::sort(points.begin(), points.end(), [](const glm::dvec2& a, const glm::dvec2& b) {
    return a.y != b.y ? a.y < b.y : a.x < b.x;
  });
  std::vector<glm::dvec2> hull;
  const auto chain = [&hull](auto first, auto last) {
    const std::size_t least = hull.size() + 1;
    for (; first != last; ++first) {
      while (hull.size() > least && turn(hull[hull.size() - 2], hull.back(), *first) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(*first);
    }
    hull.pop_back();  // the other chain begins with it
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

/// Where a row's centre line passes through the hull.
struct Passage {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();
};

/// Widens the passages of the rows whose centre lines meet a side.
void pass_side(const glm::dvec2& a, const glm::dvec2& b, std::vector<Passage>& rows) {
  const auto [top, bottom] = std::minmax(a.y, b.y);
  const auto last_row = static_cast<double>(rows.size()) - 1.0;
  const double first = std::max(std::ceil(top - 0.5), 0.0);
  const double last = std::min(std::floor(bottom - 0.5), last_row);
  const double slope = (b.x - a.x) / (b.y - a.y);
  // Ends beside the eye are far away: those keep fewer digits.
  const glm::dvec2& anchor = std::abs(a.y) < std::abs(b.y) ? a : b;
  const auto [least, most] = std::minmax(a.x, b.x);
  for (double row = first; row <= last; row += 1.0) {
    Passage& passage = rows[static_cast<std::size_t>(row)];
    if (top == bottom) {
      passage = {std::min(passage.lo, least), std::max(passage.hi, most)};
      continue;
    }
    const double x = std::clamp(anchor.x + (row + 0.5 - anchor.y) * slope, least, most);
    passage = {std::min(passage.lo, x), std::max(passage.hi, x)};
  }
}

/// The columns whose centres lie within a passage.
PixelSpan span_of(const Passage& passage, int width) {
  const double hair = kHair * width + 1e-9;
  const double first = std::max(std::ceil(passage.lo - hair - 0.5), 0.0);
  const double end = std::min(std::floor(passage.hi + hair - 0.5) + 1.0, double(width));
  if (!(first < end)) return {};
  return {static_cast<int>(first), static_cast<int>(end)};
}

}  // namespace

std::vector<PixelSpan> volume_silhouette(const Camera& camera, const glm::i64vec3& dims,
                                         const glm::dmat4& world_from_voxel) {
  const double nearest = camera.perspective ? kNearest * camera.sphere.radius_mm
                                            : -std::numeric_limits<double>::infinity();
  std::vector<Passage> rows(static_cast<std::size_t>(camera.size.y));
  const std::vector<glm::dvec2> hull = convex_hull(in_picture(
      camera, corners_before_eye(corners_seen(camera, dims, world_from_voxel), nearest)));
  for (std::size_t i = 0; i < hull.size(); ++i) {
    pass_side(hull[i], hull[(i + 1) % hull.size()], rows);
  }
  std::vector<PixelSpan> spans;
  spans.reserve(rows.size());
  for (const Passage& passage : rows) spans.push_back(span_of(passage, camera.size.x));
  return spans;
}

std::vector<PixelSpan> middle_spans(std::span<const PixelSpan> spans, int per_pixel) {
  std::vector<PixelSpan> middle;
  const auto pixels_before = [&](int ray) {  // those whose middle rays lie before it
    return std::max(ray - per_pixel / 2 + per_pixel - 1, 0) / per_pixel;
  };
  for (auto y = static_cast<std::size_t>(per_pixel / 2); y < spans.size();
       y += static_cast<std::size_t>(per_pixel)) {
    middle.push_back({pixels_before(spans[y].first), pixels_before(spans[y].end)});
  }
  return middle;
}

}  // namespace nacre

#include "render/cpu/large_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <type_traits>
#include <utility>

namespace nacre {
namespace {

/// Pixels from the target's middle up to which corners are kept: edge functions stay below 2^60.
constexpr double kReach = 1 << 19;

/// A corner in sub-pixels.
struct Point {
  std::int64_t x = 0;
  std::int64_t y = 0;
  double depth = 0.0;    ///< or 1 / depth (perspective)
  double exact_x = 0.0;  ///< before rounding
  double exact_y = 0.0;
};

/// A corner in clip coordinates x, y, depth (without perspective), w.
using ClipPoint = glm::dvec4;

/// At most 3 corners, and one more for each of 5 planes.
struct Polygon {
  std::array<ClipPoint, 8> corners{};
  std::size_t count = 0;

  void add(const ClipPoint& corner) { corners[count++] = corner; }
};

/// The part of a polygon where the plane's function is not negative.
template <class Plane>
Polygon clipped(const Polygon& polygon, const Plane& plane) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const ClipPoint& a = polygon.corners[i];
    const ClipPoint& b = polygon.corners[(i + 1) % polygon.count];
    const double at_a = plane(a);
    const double at_b = plane(b);
    if (at_a >= 0.0) result.add(a);
    if ((at_a >= 0.0) == (at_b >= 0.0)) continue;
    // From the corner that stays: the same point for both triangles of an edge.
    const bool from_a = at_a >= 0.0;
    const double part = from_a ? at_a / (at_a - at_b) : at_b / (at_b - at_a);
    const ClipPoint& from = from_a ? a : b;
    result.add(from + part * ((from_a ? b : a) - from));
  }
  return result;
}

/// Twice the area of the triangle a, b, p: what the edge from a to b says of p.
std::int64_t edge_at(const Point& a, const Point& b, std::int64_t x, std::int64_t y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

std::int64_t floor_div(std::int64_t a, std::int64_t b) {
  const std::int64_t quotient = a / b;
  return quotient * b > a ? quotient - 1 : quotient;
}

/// Where a row's centres lie on the inner side of an edge: E(x) = constant - slope * x >= 0.
void narrow(const Point& a, const Point& b, std::int64_t center_y, std::int64_t& first,
            std::int64_t& last) {
  const std::int64_t dx = b.x - a.x;
  const std::int64_t dy = b.y - a.y;
  const bool covered = dy < 0 || (dy == 0 && dx > 0);  // left and upper edges
  const std::int64_t constant =
      dx * (center_y - a.y) - dy * (kSubpixels / 2 - a.x) - (covered ? 0 : 1);
  const std::int64_t slope = dy * kSubpixels;
  if (slope > 0) {
    last = std::min(last, floor_div(constant, slope));
  } else if (slope < 0) {
    first = std::max(first, -floor_div(constant, -slope));
  } else if (constant < 0) {
    last = first - 1;
  }
}

/// Moves the depths of corners to where these were rounded, along the plane of the triangle: as
/// the kernels do for sums and tools.
void stay_on_plane(Point& a, Point& b, Point& c, bool perspective) {
  const auto across = [&](const Point& p) {
    return glm::dvec3(p.exact_x - a.exact_x, p.exact_y - a.exact_y, p.depth - a.depth);
  };
  const glm::dvec3 normal = glm::cross(across(b), across(c));
  const auto [least, greatest] = std::minmax({a.depth, b.depth, c.depth});
  double most = 0.25 * (greatest - least);
  if (perspective) most = std::min(most, 0.2 * least);
  if (normal.z == 0.0) return;
  for (Point* p : {&a, &b, &c}) {
    const double by = normal.x * (static_cast<double>(p->x) - p->exact_x) +
                      normal.y * (static_cast<double>(p->y) - p->exact_y);
    p->depth += std::clamp(-by / normal.z, -most, most);
  }
}

template <class Pixel>
class LargeCluster {
 public:
  LargeCluster(const ClusterDraw<Pixel>& draw, const ClusterProjection& projection,
               const PixelTarget<Pixel>& target)
      : draw_(draw),
        projection_(projection),
        target_(target),
        half_width_(0.5F * static_cast<float>(target.width)),
        half_height_(0.5F * static_cast<float>(target.height)) {}

  void run() {
    const Cluster& cluster = *draw_.clusters;
    const std::size_t count = cluster.triangles;
    const std::span corners(draw_.corners + cluster.first_corner, 3 * count);
    for (std::size_t t = 0; t < count; ++t) {
      const std::array<std::size_t, 3> triangle{corners[t], corners[t + count],
                                                corners[t + 2 * count]};
      if (triangle[0] == triangle[1]) continue;  // padding
      number_ = cluster.first_corner / 3 + static_cast<std::uint32_t>(t);
      draw(triangle);
    }
  }

 private:
  glm::vec3 position(std::size_t vertex) const {
    const Cluster& cluster = *draw_.clusters;
    const float* x = draw_.positions + cluster.first_position + vertex;
    return {x[0], x[cluster.vertices], x[2 * std::size_t{cluster.vertices}]};
  }

  static float at(const glm::vec4& row, const glm::vec3& p) {
    return row.x * p.x + row.y * p.y + row.z * p.z + row.w;
  }

  /// In sub-pixels, rounded to the nearest.
  static Point point(const glm::dvec2& pixel, double depth) {
    const glm::dvec2 exact = pixel * static_cast<double>(kSubpixels);
    return {std::llrint(exact.x), std::llrint(exact.y), depth, exact.x, exact.y};
  }

  bool in_reach(const glm::vec2& pixel) const {
    return std::abs(pixel.x - half_width_) < kReach && std::abs(pixel.y - half_height_) < kReach;
  }

  /// The triangle as the kernels would round it; false where that takes clipping.
  bool project(const std::array<std::size_t, 3>& triangle, std::array<Point, 3>& points) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec3 p = position(triangle[i]);
      glm::vec2 clip(at(projection_.row_x, p), at(projection_.row_y, p));
      float depth = at(projection_.row_depth, p);
      if (projection_.perspective) {
        const float w = at(projection_.row_w, p);
        if (!(w > projection_.near_mm)) return false;
        depth = 1.0F / w;
        clip *= depth;
      }
      const glm::vec2 pixel(clip.x * half_width_ + half_width_,
                            clip.y * half_height_ + half_height_);
      if (!in_reach(pixel)) return false;
      points[i] = point(pixel, depth);
    }
    return true;
  }

  void draw(const std::array<std::size_t, 3>& triangle) const {
    std::array<Point, 3> points;
    if (project(triangle, points)) {
      fill(points[0], points[1], points[2]);
    } else {
      draw_clipped(triangle);
    }
  }

  void draw_clipped(const std::array<std::size_t, 3>& triangle) const {
    Polygon polygon;
    for (const std::size_t vertex : triangle) {
      const glm::vec3 p = position(vertex);
      polygon.add({at(projection_.row_x, p), at(projection_.row_y, p), at(projection_.row_depth, p),
                   at(projection_.row_w, p)});
    }
    const double across = kReach / half_width_;
    const double down = kReach / half_height_;
    const double near = projection_.perspective ? projection_.near_mm : 0.5;
    polygon = clipped(polygon, [&](const ClipPoint& p) { return p.w - near; });
    polygon = clipped(polygon, [&](const ClipPoint& p) { return across * p.w - p.x; });
    polygon = clipped(polygon, [&](const ClipPoint& p) { return across * p.w + p.x; });
    polygon = clipped(polygon, [&](const ClipPoint& p) { return down * p.w - p.y; });
    polygon = clipped(polygon, [&](const ClipPoint& p) { return down * p.w + p.y; });
    for (std::size_t i = 2; i < polygon.count; ++i) {
      fill(point(polygon.corners[0]), point(polygon.corners[i - 1]), point(polygon.corners[i]));
    }
  }

  Point point(const ClipPoint& corner) const {
    return point({corner.x / corner.w * half_width_ + half_width_,
                  corner.y / corner.w * half_height_ + half_height_},
                 projection_.perspective ? 1.0 / corner.w : corner.z);
  }

  void fill(Point a, Point b, Point c) const {
    if constexpr (kOnPlane<Pixel>) stay_on_plane(a, b, c, projection_.perspective);
    std::int64_t area = edge_at(a, b, c.x, c.y);
    // Front faces are counter-clockwise, which has a negative area where y points down.
    const bool front = area < 0;
    if (draw_.faces == Faces::Front || (draw_.faces == Faces::Both && front)) {
      std::swap(b, c);
      area = -area;
    }
    if (area <= 0) return;
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
    const std::int64_t half = kSubpixels / 2;
    const std::int64_t first_row = std::max<std::int64_t>(0, -floor_div(half - top, kSubpixels));
    const std::int64_t last_row =
        std::min<std::int64_t>(target_.height - 1, floor_div(bottom - half, kSubpixels));
    for (std::int64_t y = first_row; y <= last_row; ++y) {
      std::int64_t first = 0;
      std::int64_t last = target_.width - 1;
      const std::int64_t center_y = y * kSubpixels + half;
      narrow(a, b, center_y, first, last);
      narrow(b, c, center_y, first, last);
      narrow(c, a, center_y, first, last);
      for (std::int64_t x = first; x <= last; ++x) {
        put(x + y * target_.width, depth_at(a, b, c, x * kSubpixels + half, center_y), front);
      }
    }
  }

  /// The depth of the triangle's plane at a point; 0 where it does not matter.
  float depth_at(const Point& a, const Point& b, const Point& c, std::int64_t x,
                 std::int64_t y) const {
    if (std::is_integral_v<Pixel> && sizeof(Pixel) <= 2 && draw_.ends == nullptr) return 0.0F;
    const auto at_a = static_cast<double>(edge_at(b, c, x, y));
    const auto at_b = static_cast<double>(edge_at(c, a, x, y));
    const auto at_c = static_cast<double>(edge_at(a, b, x, y));
    const double sum = at_a + at_b + at_c;
    const double weighed = at_a * a.depth + at_b * b.depth + at_c * c.depth;
    return static_cast<float>(projection_.perspective ? sum / weighed : weighed / sum);
  }

  void put(std::int64_t at, float depth, bool front) const {
    Pixel& pixel = target_.pixels[at];
    const float depth_mm = depth - projection_.start_mm;
    if constexpr (kCounts<Pixel>) {
      if (depth_mm > draw_.ends->of_pixels_mm[at]) pixel += front ? -1 : 1;
    } else if constexpr (kSums<Pixel>) {
      const std::int64_t steps = steps_at(at, depth_mm);
      pixel += front && draw_.brightness.is_signed ? -steps : steps;
    } else {
      if (!shows(at, depth_mm)) return;
      pixel = std::max(pixel, value_at(depth));
    }
  }

  bool shows(std::int64_t at, float depth_mm) const {
    return draw_.ends == nullptr || (depth_mm >= 0.0F && depth_mm <= draw_.ends->of_pixels_mm[at]);
  }

  /// What a crossing adds to a sum, or takes off.
  std::int64_t steps_at(std::int64_t at, float depth_mm) const {
    const Brightness<std::int64_t>& steps = draw_.brightness;
    if (!steps.is_signed && !shows(at, depth_mm)) return 0;
    if (draw_.ends != nullptr) depth_mm = std::min(depth_mm, draw_.ends->of_pixels_mm[at]);
    depth_mm = std::clamp(depth_mm, 0.0F, steps.most_depth_mm);
    return static_cast<std::int64_t>(steps.constant +
                                     depth_mm * (steps.linear + steps.square * depth_mm));
  }

  Pixel value_at(float depth) const {
    if constexpr (std::is_same_v<Pixel, float>) {
      const float z = projection_.z_of_depth.x + projection_.z_of_depth.y * depth;
      const Brightness<float>& ends = draw_.brightness;
      return ends.at_far + (ends.at_near - ends.at_far) * std::clamp(z, 0.0F, 1.0F);
    } else if constexpr (std::is_same_v<Pixel, std::uint64_t>) {
      return key_of({depth - projection_.start_mm, draw_.brightness.first_triangle + number_});
    } else {
      return draw_.brightness.rank;
    }
  }

  const ClusterDraw<Pixel>& draw_;
  const ClusterProjection& projection_;
  const PixelTarget<Pixel>& target_;
  float half_width_;
  float half_height_;
  std::uint32_t number_ = 0;  // of the triangle drawn, in its mesh
};

}  // namespace

template <class Pixel>
void draw_large_cluster(const ClusterDraw<Pixel>& draw, const ClusterProjection& projection,
                        const PixelTarget<Pixel>& target) {
  LargeCluster<Pixel>(draw, projection, target).run();
}

template void draw_large_cluster(const ClusterDraw<std::uint8_t>&, const ClusterProjection&,
                                 const PixelTarget<std::uint8_t>&);
template void draw_large_cluster(const ClusterDraw<std::uint16_t>&, const ClusterProjection&,
                                 const PixelTarget<std::uint16_t>&);
template void draw_large_cluster(const ClusterDraw<float>&, const ClusterProjection&,
                                 const PixelTarget<float>&);
template void draw_large_cluster(const ClusterDraw<std::int32_t>&, const ClusterProjection&,
                                 const PixelTarget<std::int32_t>&);
template void draw_large_cluster(const ClusterDraw<std::int64_t>&, const ClusterProjection&,
                                 const PixelTarget<std::int64_t>&);
template void draw_large_cluster(const ClusterDraw<std::uint64_t>&, const ClusterProjection&,
                                 const PixelTarget<std::uint64_t>&);

}  // namespace nacre

#include "shells/field_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nacre {
namespace {

/// A convex polygon: a triangle cut by planes along three axes has at most nine corners.
struct Polygon {
  std::array<glm::dvec3, 12> corners;
  std::size_t size = 0;

  void add(const glm::dvec3& p) {
    if (size < corners.size()) corners[size++] = p;
  }
};

/// The part of a polygon on one side of the plane p[axis] = at.
Polygon clipped(const Polygon& polygon, int axis, double at, bool above) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const glm::dvec3& p = polygon.corners[i];
    const glm::dvec3& q = polygon.corners[(i + 1) % polygon.size];
    const double sp = above ? p[axis] - at : at - p[axis];
    const double sq = above ? q[axis] - at : at - q[axis];
    if (sp >= 0.0) part.add(p);
    if ((sp < 0.0) != (sq < 0.0) && sp != 0.0 && sq != 0.0) {
      glm::dvec3 crossing = p + (q - p) * (sp / (sp - sq));
      crossing[axis] = at;  // exactly, or the neighbouring cell's field would enter
      part.add(crossing);
    }
  }
  return part;
}

class BoundsOfPieces {
 public:
  explicit BoundsOfPieces(const TrilinearField& field) : field_(field) {}

  /// Cuts along `axis` and the axes after it, then bounds the pieces.
  void add(const Polygon& polygon, int axis) {
    if (polygon.size < 3) return;
    if (axis == 3) {
      for (std::size_t i = 1; i + 1 < polygon.size; ++i) {
        add_piece(polygon.corners[0], polygon.corners[i], polygon.corners[i + 1]);
      }
      return;
    }
    double lo = polygon.corners[0][axis];
    double hi = lo;
    for (std::size_t i = 1; i < polygon.size; ++i) {
      lo = std::min(lo, polygon.corners[i][axis]);
      hi = std::max(hi, polygon.corners[i][axis]);
    }
    const double first = std::max(std::floor(lo) + 1.0, field_.box().lo[axis]);
    const double last = std::min(std::ceil(hi) - 1.0, field_.box().hi[axis]);
    if (first > last) return add(polygon, axis + 1);
    Polygon rest = polygon;
    for (double plane = first; plane <= last; plane += 1.0) {
      add(clipped(rest, axis, plane, false), axis + 1);
      rest = clipped(rest, axis, plane, true);
    }
    add(rest, axis + 1);
  }

  ValueBounds result() const { return {lo_, hi_}; }

 private:
  double value(double x, double y, double z) const { return field_.value({x, y, z}); }

  void extend(double coefficient) {
    lo_ = std::min(lo_, coefficient);
    hi_ = std::max(hi_, coefficient);
  }

  /// The coefficient of two corners p and one q: the mean over which coordinate is q's.
  double two_and_one(const glm::dvec3& p, const glm::dvec3& q) const {
    return (value(q.x, p.y, p.z) + value(p.x, q.y, p.z) + value(p.x, p.y, q.z)) / 3.0;
  }

  void add_piece(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    for (const glm::dvec3& p : {a, b, c}) extend(field_.value(p));
    extend(two_and_one(a, b));
    extend(two_and_one(b, a));
    extend(two_and_one(b, c));
    extend(two_and_one(c, b));
    extend(two_and_one(c, a));
    extend(two_and_one(a, c));
    extend((value(a.x, b.y, c.z) + value(a.x, c.y, b.z) + value(b.x, a.y, c.z) +
            value(b.x, c.y, a.z) + value(c.x, a.y, b.z) + value(c.x, b.y, a.z)) /
           6.0);
  }

  const TrilinearField& field_;
  double lo_ = std::numeric_limits<double>::infinity();
  double hi_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

ValueBounds value_bounds(const TrilinearField& field, const glm::dvec3& a, const glm::dvec3& b,
                         const glm::dvec3& c) {
  Polygon triangle;
  for (const glm::dvec3& p : {a, b, c}) triangle.add(p);
  BoundsOfPieces bounds(field);
  bounds.add(triangle, 0);
  return bounds.result();
}

}  // namespace nacre

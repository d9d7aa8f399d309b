#include "shells/field_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <optional>

namespace nacre {
namespace {

/// The values of 4 x 4 x 4 samples, x fastest.
using Block = std::array<double, 64>;

/// @param first  sample; beyond the volume a value is that of the nearest sample
template <class T>
void load(const Volume& volume, const glm::ivec3& first, Block& block) {
  const T* samples = samples_as<T>(volume).data();
  const auto place = [&](int index, int axis) {
    return static_cast<std::size_t>(std::clamp<std::int64_t>(index, 0, volume.dims[axis] - 1));
  };
  const std::array<std::size_t, 4> x{place(first.x, 0), place(first.x + 1, 0),
                                     place(first.x + 2, 0), place(first.x + 3, 0)};
  const auto nx = static_cast<std::size_t>(volume.dims.x);
  const auto ny = static_cast<std::size_t>(volume.dims.y);
  std::size_t i = 0;
  for (int dz = 0; dz < 4; ++dz) {
    for (int dy = 0; dy < 4; ++dy) {
      const T* row = samples + nx * (place(first.y + dy, 1) + ny * place(first.z + dz, 2));
      for (const std::size_t column : x) {
        block[i++] = volume.slope * static_cast<double>(row[column]) + volume.intercept;
      }
    }
  }
}

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

/// The trilinear function of one cell, also beyond it, in the cell's own coordinates.
class CellFunction {
 public:
  /// @param block  the cell's corners are its samples 1 and 2 along each axis
  explicit CellFunction(const Block& block) {
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const std::size_t x = 1 + (corner & 1U);
      const std::size_t y = 1 + (corner >> 1U & 1U);
      const std::size_t z = 1 + (corner >> 2U);
      corners_[corner] = block[x + 4 * (y + 4 * z)];
    }
  }

  double operator()(double x, double y, double z) const {
    const auto along_x = [&](std::size_t i) {
      return corners_[i] + (corners_[i + 1] - corners_[i]) * x;
    };
    const double near = along_x(0) + (along_x(2) - along_x(0)) * y;
    const double far = along_x(4) + (along_x(6) - along_x(4)) * y;
    return near + (far - near) * z;
  }

 private:
  std::array<double, 8> corners_;
};

void extend(ValueBounds& bounds, double coefficient) {
  bounds.lo = std::min(bounds.lo, coefficient);
  bounds.hi = std::max(bounds.hi, coefficient);
}

/// Bernstein coefficients of a trilinear function over a triangle.
ValueBounds bernstein_bounds(const CellFunction& f, const glm::dvec3& a, const glm::dvec3& b,
                             const glm::dvec3& c) {
  ValueBounds bounds{f(a.x, a.y, a.z), f(a.x, a.y, a.z)};
  extend(bounds, f(b.x, b.y, b.z));
  extend(bounds, f(c.x, c.y, c.z));
  // Two corners p and one q: the mean over which coordinate is q's.
  const auto two_and_one = [&](const glm::dvec3& p, const glm::dvec3& q) {
    extend(bounds, (f(q.x, p.y, p.z) + f(p.x, q.y, p.z) + f(p.x, p.y, q.z)) / 3.0);
  };
  two_and_one(a, b);
  two_and_one(b, a);
  two_and_one(b, c);
  two_and_one(c, b);
  two_and_one(c, a);
  two_and_one(a, c);
  extend(bounds, (f(a.x, b.y, c.z) + f(a.x, c.y, b.z) + f(b.x, a.y, c.z) + f(b.x, c.y, a.z) +
                  f(c.x, a.y, b.z) + f(c.x, b.y, a.z)) /
                     6.0);
  return bounds;
}

/// A cell of the field around a point, its surroundings, and the corner it is measured from.
struct Surroundings {
  Block block;
  glm::dvec3 corner;
};

Surroundings surroundings_of(const TrilinearField& field, const glm::dvec3& p) {
  Surroundings cell;
  cell.corner = glm::floor(p);
  // Far outside nothing changes any more, and integers would overflow.
  const glm::dvec3 first = glm::clamp(cell.corner, field.box().lo - 4.0, field.box().hi + 4.0);
  const Volume& volume = field.volume();
  visit_scalar_type(volume.type, [&](auto zero) {
    load<decltype(zero)>(volume, glm::ivec3(first) - 1, cell.block);
  });
  return cell;
}

/// The largest difference of neighbouring samples along an axis in a block.
double steepest(const Block& block, int axis) {
  const std::size_t stride = axis == 0 ? 1 : axis == 1 ? 4 : 16;
  double most = 0.0;
  for (std::size_t i = 0; i + stride < block.size(); ++i) {
    if (i / stride % 4 == 3) continue;
    most = std::max(most, std::abs(block[i + stride] - block[i]));
  }
  return most;
}

// How far beyond a cell a triangle may reach to be taken as within it: vertices of a contour lie on
// cells' edges, and snapping moves them a little to either side.
constexpr double kSpill = 0.05;

/// Bounds over a triangle that keeps within a cell but for a little. Beyond the cell its function
/// and the field part from the value at the cell's face, each by no more than the largest
/// difference of samples around times the way.
std::optional<ValueBounds> bounds_in_one_cell(const TrilinearField& field, const glm::dvec3& a,
                                              const glm::dvec3& b, const glm::dvec3& c) {
  const Surroundings cell = surroundings_of(field, (a + b + c) / 3.0);
  const glm::dvec3 lo = glm::min(glm::min(a, b), c) - cell.corner;
  const glm::dvec3 hi = glm::max(glm::max(a, b), c) - cell.corner;
  const glm::dvec3 spill = glm::max(glm::max(-lo, hi - 1.0), glm::dvec3(0.0));
  if (spill.x > kSpill || spill.y > kSpill || spill.z > kSpill) return std::nullopt;
  ValueBounds bounds =
      bernstein_bounds(CellFunction(cell.block), a - cell.corner, b - cell.corner, c - cell.corner);
  for (int axis = 0; axis < 3; ++axis) {
    if (spill[axis] == 0.0) continue;
    const double slack = (1.0 + 1.21) * spill[axis] * steepest(cell.block, axis);
    bounds.lo -= slack;
    bounds.hi += slack;
  }
  return bounds;
}

/// Cuts polygons along the cells' faces and bounds the pieces.
class BoundsOfPieces {
 public:
  explicit BoundsOfPieces(const TrilinearField& field) : field_(field) {}

  /// Cuts along `axis` and the axes after it.
  void add(const Polygon& polygon, int axis) {
    if (polygon.size < 3) return;
    if (axis == 3) return add_pieces(polygon);
    double lo = polygon.corners[0][axis];
    double hi = lo;
    for (std::size_t i = 1; i < polygon.size; ++i) {
      lo = std::min(lo, polygon.corners[i][axis]);
      hi = std::max(hi, polygon.corners[i][axis]);
    }
    // Beyond the box the field is constant along the axis, and nothing need be cut.
    const double first = std::max(std::floor(lo) + 1.0, std::ceil(field_.box().lo[axis]));
    const double last = std::min(std::ceil(hi) - 1.0, std::floor(field_.box().hi[axis]));
    Polygon rest = polygon;
    for (double plane = first; plane <= last; plane += 1.0) {
      add(clipped(rest, axis, plane, false), axis + 1);
      rest = clipped(rest, axis, plane, true);
    }
    add(rest, axis + 1);
  }

  ValueBounds result() const { return bounds_; }

 private:
  /// A polygon within one cell, as a fan of triangles.
  void add_pieces(const Polygon& polygon) {
    glm::dvec3 center(0.0);
    for (std::size_t i = 0; i < polygon.size; ++i) center += polygon.corners[i];
    center /= static_cast<double>(polygon.size);
    const Surroundings cell = surroundings_of(field_, center);
    const CellFunction f(cell.block);
    for (std::size_t i = 1; i + 1 < polygon.size; ++i) {
      const ValueBounds piece =
          bernstein_bounds(f, polygon.corners[0] - cell.corner, polygon.corners[i] - cell.corner,
                           polygon.corners[i + 1] - cell.corner);
      extend(bounds_, piece.lo);
      extend(bounds_, piece.hi);
    }
  }

  const TrilinearField& field_;
  ValueBounds bounds_{std::numeric_limits<double>::infinity(),
                      -std::numeric_limits<double>::infinity()};
};

}  // namespace

ValueBounds value_bounds(const TrilinearField& field, const glm::dvec3& a, const glm::dvec3& b,
                         const glm::dvec3& c) {
  if (const auto bounds = bounds_in_one_cell(field, a, b, c)) return *bounds;
  Polygon triangle;
  for (const glm::dvec3& p : {a, b, c}) triangle.add(p);
  BoundsOfPieces bounds(field);
  bounds.add(triangle, 0);
  return bounds.result();
}

}  // namespace nacre

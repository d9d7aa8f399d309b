#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "core/camera.h"

namespace nacre {

/// Coordinates in which a ray runs along +z: the axes are permuted and sheared, not turned.
///
/// Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection", section 3: the steepest axis
/// becomes z, and x, y are sheared by the ray's slopes, so that the ray is x = y = 0 and a point's
/// z is its distance t along the ray. What a point becomes depends on nothing but the point and the
/// ray: triangles that share a vertex agree on it to the last bit.
class RayCoordinates {
 public:
  /// @param ray  direction not zero
  explicit RayCoordinates(const Ray& ray);

  /// (x, y, t) of a point in LPS mm; x = y = 0 on the ray, t in mm from its origin.
  glm::dvec3 operator()(const glm::dvec3& p_mm) const {
    const glm::dvec3 from_origin = p_mm - origin_;
    const double along = from_origin[z_];
    return {from_origin[x_] - shear_.x * along, from_origin[y_] - shear_.y * along, scale_ * along};
  }

  /// The axis that became z.
  int steepest_axis() const { return z_; }

  /// t of the plane where that axis has the given coordinate; rises or falls with it, like the t of
  /// a point.
  double t_of_plane(double coordinate_mm) const { return scale_ * (coordinate_mm - origin_[z_]); }

 private:
  glm::dvec3 origin_;
  glm::dvec2 shear_{0.0};
  double scale_ = 1.0;
  int x_ = 0;
  int y_ = 1;
  int z_ = 2;
};

/// Where a ray crosses a triangle.
struct TriangleCrossing {
  double t_mm = 0.0;
  bool entering = false;    ///< through the face that is counter-clockwise seen from the origin
  glm::dvec3 weights{0.0};  ///< barycentric: of the three corners; sum 1, none negative
};

/// Sign of a b - c d, exactly (also where the products round to the same, or underflow): -1, 0, 1.
int sign_of_difference(double a, double b, double c, double d) noexcept;

/// On which side of the ray the edge from b to c passes, in the ray's frame: +1 if it runs
/// counter-clockwise about it, -1 if clockwise; 0 only if b = c.
///
/// The sign of b.x c.y - b.y c.x, exactly. Where it is 0 the ray meets the edge's line, and counts
/// as moved by the infinitesimals (e, e^2): Edelsbrunner, Muecke 1990, "Simulation of Simplicity".
/// Every decision is thus that of one ray in general position, whichever triangle asks.
inline int edge_side(const glm::dvec2& b, const glm::dvec2& c) noexcept {
  const int sign = sign_of_difference(b.x, c.y, b.y, c.x);
  if (sign != 0) return sign;
  if (b.y != c.y) return b.y > c.y ? 1 : -1;
  if (b.x != c.x) return c.x > b.x ? 1 : -1;
  return 0;
}

/// Where a ray crosses the triangle a, b, c given in the ray's frame; nothing if it passes by.
///
/// Watertight in the strict sense (docs/derivations.md, R1): of the triangles around a
/// shared edge or vertex that the ray goes through, exactly those are crossed that a ray in general
/// position beside it crosses. A closed surface is therefore entered as often as it is left, along
/// every ray, without exception; triangles without area as seen from the ray are never crossed.
///
/// t is interpolated from the corners and lies between theirs.
std::optional<TriangleCrossing> crossing(const glm::dvec3& a, const glm::dvec3& b,
                                         const glm::dvec3& c) noexcept;

// Inline: the innermost loop of all that follows rays through triangles.

namespace detail {
int sign_of_tied_difference(double a, double b, double c, double d) noexcept;
}

inline int sign_of_difference(double a, double b, double c, double d) noexcept {
  // Rounding is monotone: products that differ after it differ the same way before it.
  const double ab = a * b;
  const double cd = c * d;
  if (ab > cd) return 1;
  if (ab < cd) return -1;
  return detail::sign_of_tied_difference(a, b, c, d);
}

inline std::optional<TriangleCrossing> crossing(const glm::dvec3& a, const glm::dvec3& b,
                                                const glm::dvec3& c) noexcept {
  const int side = edge_side(b, c);
  if (side == 0 || edge_side(c, a) != side || edge_side(a, b) != side) return std::nullopt;
  // The rounded areas have the exact signs or are 0.
  glm::dvec3 weights(std::abs(b.x * c.y - b.y * c.x), std::abs(c.x * a.y - c.y * a.x),
                     std::abs(a.x * b.y - a.y * b.x));
  const double area = weights.x + weights.y + weights.z;
  weights = area > 0.0 ? weights / area : glm::dvec3(1.0 / 3.0);
  const auto [least, greatest] = std::minmax({a.z, b.z, c.z});
  const double t = weights.x * a.z + weights.y * b.z + weights.z * c.z;
  return TriangleCrossing{std::clamp(t, least, greatest), side < 0, weights};
}

}  // namespace nacre

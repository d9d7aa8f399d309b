#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "reference/cubic.h"

namespace nacre {

/// Values at a cell's corners: corner (x, y, z), each 0 or 1, is element x + 2 y + 4 z.
using CellCorners = std::array<double, 8>;

/// The trilinear interpolant of the corners at p in [0, 1]^3.
double trilinear(const CellCorners& corners, const glm::dvec3& p) noexcept;

/// The trilinear interpolant along the segment from p to q, both in [0, 1]^3, as a cubic in s in
/// [0, 1].
///
/// With F(x, y, z) the trilinear form, which is affine in each argument, the Bernstein coefficients
/// are its values at mixed arguments (its polarisation, docs/derivations.md, section 2):
///
///     b0 = F(p, p, p),                    b1 = (F(q, p, p) + F(p, q, p) + F(p, p, q)) / 3,
///     b3 = F(q, q, q),                    b2 = (F(p, q, q) + F(q, p, q) + F(q, q, p)) / 3.
///
/// Only interpolations between corners: no cancellation, no power basis, any segment.
BernsteinCubic cubic_along(const CellCorners& corners, const glm::dvec3& p,
                           const glm::dvec3& q) noexcept;

// Inline: the innermost loop of the exact walk.

inline double trilinear(const CellCorners& c, const glm::dvec3& p) noexcept {
  const auto mix = [](double a, double b, double s) { return a + (b - a) * s; };
  return mix(mix(mix(c[0], c[1], p.x), mix(c[2], c[3], p.x), p.y),
             mix(mix(c[4], c[5], p.x), mix(c[6], c[7], p.x), p.y), p.z);
}

inline BernsteinCubic cubic_along(const CellCorners& c, const glm::dvec3& p,
                                  const glm::dvec3& q) noexcept {
  const auto mix = [](double a, double b, double s) { return a + (b - a) * s; };
  // The form at the eight mixed arguments, halving a dimension at a time.
  std::array<double, 4> at_px{};
  std::array<double, 4> at_qx{};
  for (std::size_t yz = 0; yz < 4; ++yz) {
    at_px[yz] = mix(c[2 * yz], c[2 * yz + 1], p.x);
    at_qx[yz] = mix(c[2 * yz], c[2 * yz + 1], q.x);
  }
  const double ppp = mix(mix(at_px[0], at_px[1], p.y), mix(at_px[2], at_px[3], p.y), p.z);
  const double ppq = mix(mix(at_px[0], at_px[1], p.y), mix(at_px[2], at_px[3], p.y), q.z);
  const double pqp = mix(mix(at_px[0], at_px[1], q.y), mix(at_px[2], at_px[3], q.y), p.z);
  const double pqq = mix(mix(at_px[0], at_px[1], q.y), mix(at_px[2], at_px[3], q.y), q.z);
  const double qpp = mix(mix(at_qx[0], at_qx[1], p.y), mix(at_qx[2], at_qx[3], p.y), p.z);
  const double qpq = mix(mix(at_qx[0], at_qx[1], p.y), mix(at_qx[2], at_qx[3], p.y), q.z);
  const double qqp = mix(mix(at_qx[0], at_qx[1], q.y), mix(at_qx[2], at_qx[3], q.y), p.z);
  const double qqq = mix(mix(at_qx[0], at_qx[1], q.y), mix(at_qx[2], at_qx[3], q.y), q.z);
  constexpr double kThird = 1.0 / 3.0;
  // Averages written as offsets: equal corners give exactly their value.
  return {{ppp, qpp + ((pqp - qpp) + (ppq - qpp)) * kThird,
           pqq + ((qpq - pqq) + (qqp - pqq)) * kThird, qqq}};
}

}  // namespace nacre

#include "reference/triangle_crossing.h"

#include <cmath>
#include <utility>

namespace nacre {
namespace {

int sign_of(double x) { return (x > 0.0 ? 1 : 0) - (x < 0.0 ? 1 : 0); }

/// A product as m * 2^exponent, m (a product of two numbers from [1/2, 1)) not yet rounded.
struct ScaledProduct {
  double m0 = 0.0;
  double m1 = 0.0;
  int exponent = 0;

  ScaledProduct(double a, double b) {
    int exponent_a = 0;
    int exponent_b = 0;
    m0 = std::frexp(a, &exponent_a);
    m1 = std::frexp(b, &exponent_b);
    exponent = exponent_a + exponent_b;
  }
};

}  // namespace

int detail::sign_of_tied_difference(double a, double b, double c, double d) noexcept {
  const int sign_ab = sign_of(a) * sign_of(b);
  const int sign_cd = sign_of(c) * sign_of(d);
  if (sign_ab != sign_cd) return sign_ab > sign_cd ? 1 : -1;
  if (sign_ab == 0) return 0;
  // Mantissas away from underflow; products that tie though their sizes differ have underflowed.
  ScaledProduct ab(a, b);
  ScaledProduct cd(c, d);
  const int shift = ab.exponent - cd.exponent;
  if (shift > 1) return sign_ab;
  if (shift < -1) return -sign_ab;
  ab.m0 = std::ldexp(ab.m0, shift);
  const double high_ab = ab.m0 * ab.m1;
  const double high_cd = cd.m0 * cd.m1;
  if (high_ab != high_cd) return high_ab > high_cd ? 1 : -1;
  // Equal when rounded: what rounding left off decides, and a fused multiply-add has it exactly.
  return sign_of(std::fma(ab.m0, ab.m1, -high_ab) - std::fma(cd.m0, cd.m1, -high_cd));
}

RayCoordinates::RayCoordinates(const Ray& ray) : origin_(ray.origin_mm) {
  const glm::dvec3& d = ray.direction;
  for (const int axis : {0, 1, 2}) {
    if (std::abs(d[axis]) > std::abs(d[z_])) z_ = axis;
  }
  x_ = (z_ + 1) % 3;
  y_ = (z_ + 2) % 3;
  if (d[z_] < 0.0) std::swap(x_, y_);  // keeps the frame right-handed, and the winding with it
  shear_ = {d[x_] / d[z_], d[y_] / d[z_]};
  scale_ = 1.0 / d[z_];
}

}  // namespace nacre

#pragma once

#include <array>

#include "reference/cubic.h"

namespace nacre {

/// A quartic polynomial on [0, 1] in Bernstein form: what a cubic becomes under a linear cue.
struct BernsteinQuartic {
  std::array<double, 5> b;
};

/// (w0 (1-s) + w1 s) f(s). Its coefficients are means of products, with positive weights
/// (docs/derivations.md, section 2.5):
///
///     c_k = (k w1 b_(k-1) + (4-k) w0 b_k) / 4.
BernsteinQuartic product(double w0, double w1, const BernsteinCubic& f) noexcept;

/// Points inside (0, 1) where the quartic may have a maximum or minimum: the sign changes of its
/// derivative, a cubic, found as `crossings` finds them.
UnitRoots critical_points(const BernsteinQuartic& f) noexcept;

}  // namespace nacre

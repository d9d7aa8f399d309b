#pragma once

#include <array>
#include <cstddef>

namespace nacre {

/// A cubic polynomial on [0, 1] in Bernstein form:
///
///     f(s) = b0 (1-s)^3 + 3 b1 (1-s)^2 s + 3 b2 (1-s) s^2 + b3 s^3.
///
/// The form is chosen for its conditioning: f stays between the least and the greatest coefficient,
/// its end values and its mean (b0 + b1 + b2 + b3) / 4 come without cancellation, and degenerate
/// cubics (constant, linear, quadratic) are no special case. See docs/derivations.md, section 2.
struct BernsteinCubic {
  std::array<double, 4> b;
};

/// Values of s inside (0, 1), ascending: at most as many as a cubic has.
struct UnitRoots {
  std::array<double, 3> s{};
  std::size_t count = 0;
};

/// f(s), by de Casteljau's algorithm.
double evaluate(const BernsteinCubic& f, double s) noexcept;

/// The cubic's part over [s0, s1], as a cubic on [0, 1] again (by blossoming).
BernsteinCubic restrict_to(const BernsteinCubic& f, double s0, double s1) noexcept;

/// Points inside (0, 1) where f' changes sign; at most two. Exact for constant, linear and
/// quadratic cases; coefficients up to 1e307 do not overflow.
UnitRoots critical_points(const BernsteinCubic& f) noexcept;

/// max { f(s) : 0 <= s <= 1 }: over the ends and the roots of the derivative.
double maximum(const BernsteinCubic& f) noexcept;

/// Points inside (0, 1) where f crosses `level`, to the last bit or two of s: one in each interval
/// between critical points whose ends lie on different sides. A touch without crossing is no
/// crossing.
UnitRoots crossings(const BernsteinCubic& f, double level) noexcept;

}  // namespace nacre

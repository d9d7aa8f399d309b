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

/// The place between s0 and s1, where f is monotone, at which it crosses `level`, rising or
/// falling: the last bits of s. Where rounding has put both ends on one side it is the end nearer
/// the level.
double crossing_between(const BernsteinCubic& f, double level, double s0, double s1,
                        bool rising) noexcept;

/// Follows f over [0, 1] through a ladder of levels: calls `on_crossing(index, s, rising)` for each
/// crossing, by ascending s; false ends it.
///
/// A level is reached where f >= level. The number of reached levels is carried along, so that it
/// changes by one a crossing and none is lost, whatever rounding does: a count that f(0)
/// contradicts is set right by crossings at s = 0. A touch from below counts as two crossings, one
/// each way.
///
/// @param count    number of levels
/// @param level    `double(std::size_t)`: the levels, ascending
/// @param reached  how many were reached on arrival at s = 0
/// @return         how many are at s = 1 (or where it ended)
template <class LevelOf, class OnCrossing>
std::size_t follow_crossings(const BernsteinCubic& f, std::size_t count, LevelOf&& level,
                             std::size_t reached, OnCrossing&& on_crossing);

// Implementation of the template.

template <class LevelOf, class OnCrossing>
std::size_t follow_crossings(const BernsteinCubic& f, std::size_t count, LevelOf&& level,
                             std::size_t reached, OnCrossing&& on_crossing) {
  // To where f1 = f(s1), from s: between them f is monotone. False: ended.
  const auto follow = [&](double s, double s1, double f1) {
    for (; reached < count && level(reached) <= f1; ++reached) {
      if (s < s1) s = crossing_between(f, level(reached), s, s1, true);
      if (!on_crossing(reached, s, true)) return false;
    }
    for (; reached > 0 && level(reached - 1) > f1; --reached) {
      if (s < s1) s = crossing_between(f, level(reached - 1), s, s1, false);
      if (!on_crossing(reached - 1, s, false)) return false;
    }
    return true;
  };
  if (!follow(0.0, 0.0, f.b[0])) return reached;
  const UnitRoots critical = critical_points(f);
  double s0 = 0.0;
  for (std::size_t i = 0; i < critical.count; ++i) {
    if (!follow(s0, critical.s[i], evaluate(f, critical.s[i]))) return reached;
    s0 = critical.s[i];
  }
  follow(s0, 1.0, f.b[3]);
  return reached;
}

}  // namespace nacre

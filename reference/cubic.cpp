#include "reference/cubic.h"

#include <algorithm>
#include <cmath>

namespace nacre {
namespace {

double mix(double a, double b, double s) { return a + (b - a) * s; }

/// The blossom (polar form) of f at (r, s, t): symmetric, affine in each argument.
double blossom(const BernsteinCubic& f, double r, double s, double t) {
  const double c0 = mix(f.b[0], f.b[1], r);
  const double c1 = mix(f.b[1], f.b[2], r);
  const double c2 = mix(f.b[2], f.b[3], r);
  return mix(mix(c0, c1, s), mix(c1, c2, s), t);
}

/// Adds s when it lies inside (0, 1) and beyond the last one.
void append(UnitRoots& roots, double s) {
  const double last = roots.count > 0 ? roots.s[roots.count - 1] : 0.0;
  if (s > last && s < 1.0) roots.s[roots.count++] = s;
}

}  // namespace

double evaluate(const BernsteinCubic& f, double s) noexcept { return blossom(f, s, s, s); }

BernsteinCubic restrict_to(const BernsteinCubic& f, double s0, double s1) noexcept {
  return {{blossom(f, s0, s0, s0), blossom(f, s0, s0, s1), blossom(f, s0, s1, s1),
           blossom(f, s1, s1, s1)}};
}

UnitRoots critical_points(const BernsteinCubic& f) noexcept {
  UnitRoots roots;
  double d0 = f.b[1] - f.b[0];
  double d1 = f.b[2] - f.b[1];
  double d2 = f.b[3] - f.b[2];
  // Coefficients of one sign: the derivative has no root inside (convex hull property).
  if ((d0 >= 0.0 && d1 >= 0.0 && d2 >= 0.0) || (d0 <= 0.0 && d1 <= 0.0 && d2 <= 0.0)) return roots;

  // f'/3 = d0 (1-s)^2 + 2 d1 (1-s) s + d2 s^2, scaled so that products neither over- nor underflow.
  const double scale = std::max({std::abs(d0), std::abs(d1), std::abs(d2)});
  d0 /= scale;
  d1 /= scale;
  d2 /= scale;
  const double discriminant = d1 * d1 - d0 * d2;
  if (discriminant <= 0.0) return roots;
  // In u = s / (1 - s): d2 u^2 + 2 d1 u + d0 = 0; q avoids cancellation. Its roots q / d2 and
  // d0 / q become s = u / (1 + u), which is fine for u at infinity too.
  const double q = -(d1 + std::copysign(std::sqrt(discriminant), d1));
  const double first = q / (q + d2);
  const double second = d0 / (d0 + q);
  append(roots, std::min(first, second));
  append(roots, std::max(first, second));
  return roots;
}

double maximum(const BernsteinCubic& f) noexcept {
  double best = std::max(f.b[0], f.b[3]);
  if (f.b[1] <= best && f.b[2] <= best) return best;
  const UnitRoots critical = critical_points(f);
  for (std::size_t i = 0; i < critical.count; ++i) {
    best = std::max(best, evaluate(f, critical.s[i]));
  }
  return best;
}

// Newton's steps, kept in a bracket that they or bisection shrink.
double crossing_between(const BernsteinCubic& f, double level, double s0, double s1,
                        bool rising) noexcept {
  constexpr int kMostSteps = 128;
  double s = 0.5 * (s0 + s1);
  for (int step = 0; step < kMostSteps; ++step) {
    const double value = evaluate(f, s) - level;
    if (value == 0.0) return s;
    ((value < 0.0) == rising ? s0 : s1) = s;
    const double slope = 3.0 * mix(mix(f.b[1] - f.b[0], f.b[2] - f.b[1], s),
                                   mix(f.b[2] - f.b[1], f.b[3] - f.b[2], s), s);
    double next = s - value / slope;
    // Outside the bracket, or NaN from a zero slope.
    if (!(next > s0 && next < s1)) next = 0.5 * (s0 + s1);
    if (next == s || next == s0 || next == s1) return next;
    if (std::abs(next - s) <= 1e-16) return next;
    s = next;
  }
  return s;
}

UnitRoots crossings(const BernsteinCubic& f, double level) noexcept {
  UnitRoots roots;
  const auto [least, greatest] = std::minmax_element(f.b.begin(), f.b.end());
  if (level < *least || level > *greatest) return roots;

  const UnitRoots critical = critical_points(f);
  double s0 = 0.0;
  double f0 = f.b[0] - level;
  for (std::size_t i = 0; i <= critical.count; ++i) {
    const double s1 = i < critical.count ? critical.s[i] : 1.0;
    const double f1 = i < critical.count ? evaluate(f, s1) - level : f.b[3] - level;
    if ((f0 < 0.0 && f1 > 0.0) || (f0 > 0.0 && f1 < 0.0)) {
      append(roots, crossing_between(f, level, s0, s1, f0 < 0.0));
    } else if (f1 == 0.0 && i < critical.count) {
      append(roots, s1);  // harmless where it only touches: it just splits an interval
    }
    s0 = s1;
    f0 = f1;
  }
  return roots;
}

}  // namespace nacre

#include "tests/support/extended_cell.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/test_volumes.h"

namespace nacre::testing {
namespace {

template <class F>
long double simpson(const F& f, long double a, long double b, long double fa, long double fm,
                    long double fb, int depth) {
  const long double m = (a + b) / 2;
  const long double fl = f((a + m) / 2);
  const long double fr = f((m + b) / 2);
  const long double whole = (b - a) / 6 * (fa + 4 * fm + fb);
  const long double halves = (b - a) / 12 * (fa + 4 * fl + 2 * fm + 4 * fr + fb);
  if (depth == 0 || std::abs(halves - whole) < 1e-16L) return halves;
  return simpson(f, a, m, fa, fl, fm, depth - 1) + simpson(f, m, b, fm, fr, fb, depth - 1);
}

/// By thirds, in [lo, hi] where f has one maximum.
template <class F>
long double single_maximum(const F& f, long double lo, long double hi) {
  constexpr int kThirds = 110;  // (2/3)^110 = 4e-20
  for (int i = 0; i < kThirds; ++i) {
    const long double a = lo + (hi - lo) / 3;
    const long double b = hi - (hi - lo) / 3;
    (f(a) < f(b) ? lo : hi) = f(a) < f(b) ? a : b;
  }
  return std::max(f(lo), f(hi));
}

}  // namespace

ExtendedCell::ExtendedCell(const Volume& volume, const Ray& ray)
    : t_enter_(-std::numeric_limits<long double>::infinity()),
      t_exit_(std::numeric_limits<long double>::infinity()) {
  for (std::size_t i = 0; i < 8; ++i) corner_[i] = samples_as<double>(volume)[i];
  for (int axis = 0; axis < 3; ++axis) {
    origin_[static_cast<std::size_t>(axis)] = ray.origin_mm[axis];
    direction_[static_cast<std::size_t>(axis)] = ray.direction[axis];
  }
  clip();
}

void ExtendedCell::clip() {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const long double a = (0.0L - origin_[axis]) / direction_[axis];
    const long double b = (1.0L - origin_[axis]) / direction_[axis];
    t_enter_ = std::max(t_enter_, std::min(a, b));
    t_exit_ = std::min(t_exit_, std::max(a, b));
  }
}

long double ExtendedCell::at(long double t) const {
  long double value = 0.0L;
  for (std::size_t i = 0; i < 8; ++i) {
    long double weight = 1.0L;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const long double p = origin_[axis] + t * direction_[axis];
      weight *= ((i >> axis) & 1) != 0 ? p : 1.0L - p;
    }
    value += weight * corner_[i];
  }
  return value;
}

long double ExtendedCell::maximum(const Function& of) const {
  const auto f = [&](long double t) { return of(t, at(t)); };
  constexpr int kSteps = 500;
  const long double step = (t_exit_ - t_enter_) / kSteps;
  std::vector<long double> sampled;
  for (int i = 0; i <= kSteps; ++i) sampled.push_back(f(t_enter_ + i * step));
  long double best = std::max(f(t_enter_), f(t_exit_));
  for (int i = 0; i <= kSteps; ++i) {
    const auto lo = static_cast<std::size_t>(std::max(i - 1, 0));
    const auto hi = static_cast<std::size_t>(std::min(i + 1, kSteps));
    const long double here = sampled[static_cast<std::size_t>(i)];
    // Between samples the maximum exceeds the nearest one by little.
    if (here < sampled[lo] || here < sampled[hi] || here < best - 0.01L * std::abs(best)) continue;
    best = std::max(best, single_maximum(f, t_enter_ + static_cast<long double>(lo) * step,
                                         t_enter_ + static_cast<long double>(hi) * step));
  }
  return best;
}

long double ExtendedCell::integral(const Function& of) const {
  const auto f = [&](long double t) { return of(t, at(t)); };
  long double sum = 0.0L;
  constexpr int kParts = 16;
  for (int i = 0; i < kParts; ++i) {
    const long double a = t_enter_ + (t_exit_ - t_enter_) * i / kParts;
    const long double b = t_enter_ + (t_exit_ - t_enter_) * (i + 1) / kParts;
    sum += simpson(f, a, b, f(a), f((a + b) / 2), f(b), 45);
  }
  return sum;
}

void for_random_cells(int trials,
                      const std::function<void(const Volume& cell, const Ray& ray)>& check) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < trials; ++trial) {
    const Volume cell = random_volume<double>({2, 2, 2}, 0.0, 1.0, static_cast<unsigned>(trial));
    const glm::dvec3 inside(unit(random), unit(random), unit(random));
    const glm::dvec3 outside(6.0 * unit(random) - 3.0, 6.0 * unit(random) - 3.0, -4.0);
    check(cell, {outside, glm::normalize(inside - outside)});
  }
}

}  // namespace nacre::testing

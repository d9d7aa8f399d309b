#include "reference/cued_emission.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "reference/mean_emission.h"
#include "reference/quartic.h"

namespace nacre {
namespace {

constexpr double kRounding = 1e-12;  // of the range: the promise

/// f in extended precision and power-like form.
long double value_of(const BernsteinCubic& f, long double s) {
  const long double r = 1.0L - s;
  return f.b[0] * r * r * r + 3 * f.b[1] * r * r * s + 3 * f.b[2] * r * s * s + f.b[3] * s * s * s;
}

long double emission_of(const EmissionMap& map, long double value) {
  const auto knots = map.knots();
  if (value <= knots.front().value) return knots.front().emission;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const auto& [a, from] = knots[i - 1];
    const auto& [b, to] = knots[i];
    if (value < b) return from + (to - from) * ((value - a) / (static_cast<long double>(b) - a));
  }
  return knots.back().emission;
}

long double cued_emission_at(const EmissionMap& map, const BernsteinCubic& f, const UnitCue& beta,
                             long double s) {
  return (beta.at_0 * (1.0L - s) + beta.at_1 * s) * emission_of(map, value_of(f, s));
}

/// A grid search, then finer grids about each local maximum.
long double searched_maximum(const EmissionMap& map, const BernsteinCubic& f, const UnitCue& beta) {
  constexpr int kSteps = 400;
  const auto at = [&](long double s) { return cued_emission_at(map, f, beta, s); };
  const auto step = [](int i) { return static_cast<long double>(i) / kSteps; };
  long double best = std::max(at(0.0L), at(1.0L));
  for (int i = 0; i <= kSteps; ++i) {
    long double lo = step(std::max(i - 1, 0));
    long double hi = step(std::min(i + 1, kSteps));
    if (at(step(i)) < at(lo) || at(step(i)) < at(hi)) continue;
    for (int third = 0; third < 110; ++third) {
      const long double a = lo + (hi - lo) / 3;
      const long double b = hi - (hi - lo) / 3;
      (at(a) < at(b) ? lo : hi) = at(a) < at(b) ? a : b;
    }
    best = std::max({best, at(lo), at(hi)});
  }
  return best;
}

std::vector<EmissionMap> maps() {
  return {EmissionMap::window(-1.0, 1.0), EmissionMap::window(-0.3, 0.2),
          EmissionMap::window(0.4, 0.41), EmissionMap::piecewise_linear({{-0.5, 0.2}, {0.5, 0.7}}),
          EmissionMap::piecewise_linear(
              {{-0.6, 0.05}, {-0.3, 0.2}, {0.0, 0.2}, {0.05, 0.9}, {0.1, 0.9}, {0.6, 1.0}})};
}

#ifdef NDEBUG
constexpr int kTrials = 60;
#else
constexpr int kTrials = 6;
#endif

/// Calls check(map, cubic, cue) for random cubics and cues, some with an end of 0.
template <class Check>
void for_random_cubics(int trials, Check&& check) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto value = [&] { return 2.0 * unit(random) - 1.0; };
  for (const EmissionMap& map : maps()) {
    for (int trial = 0; trial < trials; ++trial) {
      const BernsteinCubic f{{value(), value(), value(), value()}};
      UnitCue beta{unit(random), unit(random)};
      if (trial % 5 == 0) beta.at_0 = 0.0;
      if (trial % 5 == 1) beta.at_1 = 0.0;
      check(map, f, beta);
    }
  }
}

TEST(Quartic, IsTheProduct) {
  const BernsteinCubic f{{0.3, -1.0, 2.0, 0.7}};
  const BernsteinQuartic p = product(0.2, 1.7, f);
  for (const double s : {0.0, 0.2, 0.7, 1.0}) {
    const double r = 1.0 - s;
    const double value = p.b[0] * r * r * r * r + 4 * p.b[1] * r * r * r * s +
                         6 * p.b[2] * r * r * s * s + 4 * p.b[3] * r * s * s * s +
                         p.b[4] * s * s * s * s;
    EXPECT_NEAR(value, (0.2 * r + 1.7 * s) * evaluate(f, s), 1e-15);
  }
}

TEST(CuedEmission, MaximumIsThatOfAnExtendedSearch) {
  for_random_cubics(
      kTrials, [](const EmissionMap& map, const BernsteinCubic& f, const UnitCue& beta) {
        const auto expected = static_cast<double>(searched_maximum(map, f, beta));
        EXPECT_NEAR(CuedEmission(map).maximum_above(0.0, f, beta), expected, kRounding);
        EXPECT_EQ(CuedEmission(map).maximum_above(2.0, f, beta), 2.0);
      });
}

TEST(CuedEmission, MeanIsThatOfAFineSum) {
  for_random_cubics(
      kTrials, [](const EmissionMap& map, const BernsteinCubic& f, const UnitCue& beta) {
        // Midpoints: an error of order h^2 where it is smooth, of h^2 at kinks too.
        constexpr int kSteps = 4000;
        long double sum = 0.0L;
        for (int i = 0; i < kSteps; ++i) sum += cued_emission_at(map, f, beta, (i + 0.5L) / kSteps);
        EXPECT_NEAR(CuedEmission(map).mean(f, beta), static_cast<double>(sum / kSteps), 2e-5);
      });
}

TEST(CuedEmission, WithoutACueIsTheEmission) {
  for_random_cubics(kTrials, [](const EmissionMap& map, const BernsteinCubic& f, const UnitCue&) {
    EXPECT_NEAR(CuedEmission(map).maximum_above(0.0, f, {1.0, 1.0}), map(maximum(f)), 1e-14);
    EXPECT_NEAR(CuedEmission(map).mean(f, {1.0, 1.0}), mean_emission(map, f), 1e-14);
  });
}

TEST(CuedEmission, HasTheClosedFormOfALinearField) {
  // beta = 1 - s, T = s: s - s^2, maximum 1/4, mean 1/6.
  const CuedEmission unit(EmissionMap::window(0.0, 3.0));
  const BernsteinCubic rising{{0, 1, 2, 3}};
  EXPECT_NEAR(unit.maximum_above(0.0, rising, {1.0, 0.0}), 0.25, 1e-16);
  EXPECT_NEAR(unit.mean(rising, {1.0, 0.0}), 1.0 / 6.0, 1e-16);
  // Clamped at 1 from s = 1/3 on: the maximum sits at the knot.
  const CuedEmission narrow(EmissionMap::window(0.0, 1.0));
  EXPECT_NEAR(narrow.maximum_above(0.0, rising, {1.0, 0.0}), 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(narrow.mean(rising, {1.0, 0.0}), 7.0 / 54.0 + 2.0 / 9.0, 1e-15);
}

TEST(CuedEmission, DegenerateCubicsAreNoSpecialCase) {
  const CuedEmission unit(EmissionMap::window(0.0, 1.0));
  const double hair = 1e-16;
  for (const double jitter : {0.0, hair, -hair}) {
    const BernsteinCubic constant{{0.5, 0.5 + jitter, 0.5 - jitter, 0.5}};
    EXPECT_NEAR(unit.maximum_above(0.0, constant, {0.2, 0.9}), 0.45, 1e-15);
    EXPECT_NEAR(unit.mean(constant, {0.2, 0.9}), 0.275, 1e-15);
    const BernsteinCubic linear{{0.0, 1.0 / 3.0 + jitter, 2.0 / 3.0 - jitter, 1.0}};
    EXPECT_NEAR(unit.maximum_above(0.0, linear, {1.0, 0.0}), 0.25, 1e-15);
    const BernsteinCubic quadratic{{0.0, 1.0 / 3.0, 1.0 / 3.0 + jitter, 0.0}};  // s - s^2
    // (1-s) s (1-s): 4/27 at 1/3.
    EXPECT_NEAR(unit.maximum_above(0.0, quadratic, {1.0, 0.0}), 4.0 / 27.0, 1e-15);
  }
}

TEST(CuedEmission, ABlackCueIsBlack) {
  const CuedEmission unit(EmissionMap::window(0.0, 1.0));
  EXPECT_EQ(unit.maximum_above(0.0, {{1, 2, -3, 1}}, {0.0, 0.0}), 0.0);
  EXPECT_EQ(unit.mean({{1, 2, -3, 1}}, {0.0, 0.0}), 0.0);
}

TEST(CuedEmission, AWindowOfOneUlpIsAStep) {
  // A step from 1 on; f reaches it at s = 1/2, where beta = 1/2.
  const CuedEmission step(EmissionMap::window(1.0, std::nextafter(1.0, 2.0)));
  const BernsteinCubic rising{{0.0, 2.0 / 3.0, 4.0 / 3.0, 2.0}};
  EXPECT_NEAR(step.maximum_above(0.0, rising, {1.0, 0.0}), 0.5, 1e-15);
  EXPECT_NEAR(step.mean(rising, {1.0, 0.0}), 0.125, 1e-15);
  // The least step a double can make, and values as large as they come.
  const CuedEmission least(EmissionMap::window(0.0, std::numeric_limits<double>::denorm_min()));
  const BernsteinCubic huge{{-1e300, -1e300 / 3.0, 1e300 / 3.0, 1e300}};
  EXPECT_NEAR(least.maximum_above(0.0, huge, {1.0, 0.0}), 0.5, 1e-15);
  EXPECT_NEAR(least.mean(huge, {1.0, 0.0}), 0.125, 1e-15);
}

TEST(CuedEmission, HoldsForManyKnots) {
  // A parabola through 200 knots: nearly T(v) = v^2.
  std::vector<EmissionKnot> knots;
  for (int i = 0; i <= 200; ++i) knots.push_back({i / 200.0, i * i / 40000.0});
  const EmissionMap map = EmissionMap::piecewise_linear(knots);
  const BernsteinCubic f{{0.0, 0.9, 0.1, 1.0}};
  const UnitCue beta{1.0, 0.3};
  EXPECT_NEAR(CuedEmission(map).maximum_above(0.0, f, beta),
              static_cast<double>(searched_maximum(map, f, beta)), kRounding);
}

}  // namespace
}  // namespace nacre

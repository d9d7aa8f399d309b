#include "reference/cubic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "reference/trilinear_line.h"

namespace nacre {
namespace {

/// Largest of f on a fine grid, in long double and power form: an independent lower bound that lies
/// within 1e-8 of the maximum.
long double sampled_maximum(const BernsteinCubic& f) {
  constexpr int kSteps = 4000;
  const auto& b = f.b;
  long double best = -INFINITY;
  for (int i = 0; i <= kSteps; ++i) {
    const long double s = static_cast<long double>(i) / kSteps;
    const long double r = 1.0L - s;
    best = std::max(
        best, b[0] * r * r * r + 3 * b[1] * r * r * s + 3 * b[2] * r * s * s + b[3] * s * s * s);
  }
  return best;
}

TEST(Cubic, MaximumIsThatOfAFineSearch) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (int trial = 0; trial < 300; ++trial) {
    const BernsteinCubic f{{value(random), value(random), value(random), value(random)}};
    const auto sampled = static_cast<double>(sampled_maximum(f));
    EXPECT_GE(maximum(f), sampled - 1e-15);
    EXPECT_LE(maximum(f), sampled + 1e-6);  // curvature times half a step, squared
  }
}

TEST(Cubic, HumpsHaveTheirClosedFormMaximum) {
  // 3 s (1-s)^2: maximum 4/9 at 1/3. 4 s (1-s), raised to degree 3: maximum 1 at 1/2.
  EXPECT_NEAR(maximum({{0, 1, 0, 0}}), 4.0 / 9.0, 1e-15);
  EXPECT_NEAR(maximum({{0, 4.0 / 3.0, 4.0 / 3.0, 0}}), 1.0, 1e-15);
}

TEST(Cubic, ConstantLinearAndNearlyLinearAreNoSpecialCase) {
  EXPECT_EQ(maximum({{3, 3, 3, 3}}), 3.0);
  EXPECT_EQ(maximum({{0, 1, 2, 3}}), 3.0);
  EXPECT_EQ(maximum({{3, 2, 1, 0}}), 3.0);
  const double hair = 1e-16;
  EXPECT_NEAR(maximum({{0, 1 + hair, 2 - hair, 3}}), 3.0, 1e-15);
  EXPECT_NEAR(maximum({{1, 1 + 1e-15, 1 - 1e-15, 1}}), 1.0, 2e-15);
}

TEST(Cubic, HoldsFromTheSmallestToTheLargestNumbers) {
  for (const double scale : {1e-300, 1e-38, 1.0, 1e38, 1e300}) {
    EXPECT_NEAR(maximum({{0, scale, 0, 0}}) / scale, 4.0 / 9.0, 1e-14) << scale;
    EXPECT_NEAR(maximum({{-scale, scale, scale, -scale}}) / scale, 0.5, 1e-14) << scale;
  }
}

TEST(Cubic, CrossingsSplitWhereTheLevelIsMet) {
  // (s - 0.2)(s - 0.5)(s - 0.9), from its values at 0, 1 and its derivatives there.
  const auto f = [](double s) { return (s - 0.2) * (s - 0.5) * (s - 0.9); };
  const double d0 = 0.2 * 0.5 + 0.2 * 0.9 + 0.5 * 0.9;
  const double d1 = 0.8 * 0.5 + 0.8 * 0.1 + 0.5 * 0.1;
  const BernsteinCubic cubic{{f(0), f(0) + d0 / 3, f(1) - d1 / 3, f(1)}};
  const UnitRoots roots = crossings(cubic, 0.0);
  ASSERT_EQ(roots.count, 3u);
  EXPECT_NEAR(roots.s[0], 0.2, 1e-15);
  EXPECT_NEAR(roots.s[1], 0.5, 1e-15);
  EXPECT_NEAR(roots.s[2], 0.9, 1e-15);
  EXPECT_EQ(crossings(cubic, 1.0).count, 0u);
  EXPECT_EQ(crossings({{2, 2, 2, 2}}, 2.0).count, 0u);
}

TEST(Cubic, RandomCrossingsAreZerosAndAlternateInSign) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (int trial = 0; trial < 1000; ++trial) {
    const BernsteinCubic f{{value(random), value(random), value(random), value(random)}};
    const UnitRoots roots = crossings(f, 0.1);
    for (std::size_t i = 0; i < roots.count; ++i) {
      EXPECT_NEAR(evaluate(f, roots.s[i]), 0.1, 1e-14);
    }
    // An odd number of crossings exactly where the ends lie on different sides.
    EXPECT_EQ(roots.count % 2 == 1, (f.b[0] < 0.1) != (f.b[3] < 0.1));
  }
}

TEST(Cubic, RestrictionIsTheSameFunction) {
  const BernsteinCubic f{{0.3, -1.0, 2.0, 0.7}};
  const BernsteinCubic part = restrict_to(f, 0.2, 0.7);
  for (const double s : {0.0, 0.3, 0.5, 1.0}) {
    EXPECT_NEAR(evaluate(part, s), evaluate(f, 0.2 + 0.5 * s), 1e-15);
  }
}

TEST(TrilinearLine, IsTheTrilinearFieldAlongTheSegment) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    CellCorners corners;
    for (double& corner : corners) corner = 2.0 * unit(random) - 1.0;
    const glm::dvec3 p(unit(random), unit(random), unit(random));
    const glm::dvec3 q(unit(random), unit(random), unit(random));
    const BernsteinCubic f = cubic_along(corners, p, q);
    for (const double s : {0.0, 0.25, 0.5, 0.9, 1.0}) {
      EXPECT_NEAR(evaluate(f, s), trilinear(corners, p + s * (q - p)), 2e-15);
    }
  }
}

TEST(TrilinearLine, EqualCornersGiveExactlyTheirValue) {
  CellCorners corners;
  corners.fill(0.1);
  const BernsteinCubic f = cubic_along(corners, {0.1, 0.2, 0.3}, {0.9, 0.7, 0.33});
  for (const double b : f.b) EXPECT_EQ(b, 0.1);
}

}  // namespace
}  // namespace nacre

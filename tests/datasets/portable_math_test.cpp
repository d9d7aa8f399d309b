#include "datasets/portable_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nacre {
namespace {

constexpr double kRounding = 1e-15;

TEST(PortableMath, LogIsTheLogarithm) {
  for (double x = 1e-12; x < 1e12; x *= 1.37) {
    EXPECT_NEAR(portable_log(x), std::log(x), 4 * kRounding * std::max(1.0, std::abs(std::log(x))));
  }
  EXPECT_EQ(portable_log(1.0), 0.0);
}

TEST(PortableMath, ExpIsTheExponential) {
  for (double x = -600.0; x < 600.0; x += 0.731) {
    EXPECT_NEAR(portable_exp(x) / std::exp(x), 1.0, kRounding) << "x = " << x;
  }
  EXPECT_EQ(portable_exp(0.0), 1.0);
  EXPECT_EQ(portable_exp(-1e9), 0.0);
}

TEST(PortableMath, CbrtIsTheCubeRoot) {
  for (double x = 1e-30; x < 1e30; x *= 1.93) {
    EXPECT_NEAR(portable_cbrt(x) / std::cbrt(x), 1.0, kRounding) << "x = " << x;
  }
  EXPECT_EQ(portable_cbrt(0.0), 0.0);
}

TEST(PortableMath, CosSinFollowTheCircle) {
  for (double u = 0.0; u <= 1.0; u += 0.0037) {
    const CosSin circle = portable_cos_sin(u);
    EXPECT_NEAR(circle.cosine, std::cos(2.0 * std::numbers::pi * u), kRounding) << "u = " << u;
    EXPECT_NEAR(circle.sine, std::sin(2.0 * std::numbers::pi * u), kRounding) << "u = " << u;
  }
}

TEST(PortableMath, ErfIsWithinTheBoundOfItsFormula) {
  constexpr double kBound = 1.5e-7;
  for (double x = -5.0; x <= 5.0; x += 0.0173) {
    EXPECT_NEAR(portable_erf(x), std::erf(x), kBound) << "x = " << x;
    EXPECT_NEAR(portable_erfc(x), std::erfc(x), kBound) << "x = " << x;
  }
}

}  // namespace
}  // namespace nacre

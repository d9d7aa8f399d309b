#include "datasets/portable_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre {
namespace {

constexpr double kRounding = 1e-15;
constexpr double kErfBound = 1.5e-7;

TEST(PortableMath, LogIsTheLogarithm) {
  for (int i = -100; i <= 100; ++i) {
    const double x = std::pow(1.31, i);
    EXPECT_NEAR(portable_log(x), std::log(x), 4 * kRounding * std::max(1.0, std::abs(std::log(x))));
  }
  EXPECT_EQ(portable_log(1.0), 0.0);
}

TEST(PortableMath, ExpIsTheExponential) {
  for (int i = -800; i <= 800; ++i) {
    const double x = 0.731 * i;
    EXPECT_NEAR(portable_exp(x) / std::exp(x), 1.0, kRounding) << "x = " << x;
  }
  EXPECT_EQ(portable_exp(0.0), 1.0);
  EXPECT_EQ(portable_exp(-1e9), 0.0);
}

TEST(PortableMath, CbrtIsTheCubeRoot) {
  for (int i = -100; i <= 100; ++i) {
    const double x = std::pow(1.93, i);
    EXPECT_NEAR(portable_cbrt(x) / std::cbrt(x), 1.0, kRounding) << "x = " << x;
  }
  EXPECT_EQ(portable_cbrt(0.0), 0.0);
}

TEST(PortableMath, CosSinFollowTheCircle) {
  for (int i = 0; i <= 256; ++i) {
    const double u = i / 256.0;
    const CosSin circle = portable_cos_sin(u);
    EXPECT_NEAR(circle.cosine, std::cos(2.0 * std::numbers::pi * u), kRounding) << "u = " << u;
    EXPECT_NEAR(circle.sine, std::sin(2.0 * std::numbers::pi * u), kRounding) << "u = " << u;
  }
}

TEST(PortableMath, ErfIsWithinTheBoundOfItsFormula) {
  for (int i = -300; i <= 300; ++i) {
    const double x = 0.0173 * i;
    EXPECT_NEAR(portable_erf(x), std::erf(x), kErfBound) << "x = " << x;
    EXPECT_NEAR(portable_erfc(x), std::erfc(x), kErfBound) << "x = " << x;
  }
}

}  // namespace
}  // namespace nacre

#include "datasets/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace nacre {
namespace {

constexpr int kDraws = 200'000;

// Five standard deviations of a mean over the draws.
const double kChance = 5.0 / std::sqrt(kDraws);

TEST(RandomSequence, IsUniformAndRepeatable) {
  RandomSequence first(7);
  RandomSequence again(7);
  double sum = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = first.uniform();
    ASSERT_EQ(u, again.uniform());
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
  }
  EXPECT_NEAR(sum / kDraws, 0.5, kChance * std::sqrt(1.0 / 12.0));
}

// The standard requires mt19937_64's 10,000th output from its default seed.
TEST(RandomSequence, IsTheStandardsEngine) {
  RandomSequence random(5489);
  double u = 0.0;
  for (int i = 0; i < 10'000; ++i) u = random.uniform();
  EXPECT_EQ(u, static_cast<double>(std::uint64_t{9981545732273789042u} >> 11) * 0x1p-53);
}

TEST(NormalPair, HasTheMomentsOfTwoIndependentNormals) {
  glm::dvec2 mean(0.0);
  glm::dvec2 square(0.0);
  glm::dvec2 fourth(0.0);
  double product = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const glm::dvec2 n = normal_pair(1, static_cast<std::uint64_t>(i));
    mean += n / static_cast<double>(kDraws);
    square += n * n / static_cast<double>(kDraws);
    fourth += n * n * n * n / static_cast<double>(kDraws);
    product += n.x * n.y / kDraws;
  }
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(mean[k], 0.0, kChance);
    EXPECT_NEAR(square[k], 1.0, kChance * std::sqrt(2.0));
    EXPECT_NEAR(fourth[k], 3.0, kChance * std::sqrt(96.0));
  }
  EXPECT_NEAR(product, 0.0, kChance);
}

TEST(NormalPair, SeedsOneApartShareNothing) {
  double product = 0.0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    product += normal_pair(1, i).x * normal_pair(2, i).x / kDraws;
  }
  EXPECT_NEAR(product, 0.0, kChance);
  EXPECT_NE(normal_pair(1, 1), normal_pair(2, 0));
}

TEST(SmoothNoise, StaysInRangeAndIsContinuousAcrossTheLattice) {
  constexpr double shift = 1e-6;
  constexpr double steepest = 2.0 * 1.875;  // largest slope of the quintic, times the range
  double least = 1.0;
  double most = -1.0;
  for (int i = -500; i < 500; ++i) {
    const glm::dvec3 p(0.1 * i, 0.33 * i, -0.21 * i);
    const double value = smooth_noise(3, p);
    least = std::min(least, value);
    most = std::max(most, value);
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 near = p;
      near[axis] += shift;
      EXPECT_NEAR(smooth_noise(3, near), value, 1.01 * steepest * shift);
    }
  }
  EXPECT_GE(least, -1.0);
  EXPECT_LE(most, 1.0);
  EXPECT_LT(least, -0.5);
  EXPECT_GT(most, 0.5);
}

}  // namespace
}  // namespace nacre

#include "shells/picture_weight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "extract/marching_cubes.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

const EmissionMap kWindow = EmissionMap::window(0.0, 100.0);

/// A slope along x that grows: value x^2, in steps of a mm.
Volume growing_slope() {
  return testing::volume_of<float>({11, 6, 6}, [](auto i, auto, auto) { return i * i; });
}

/// Within the cell [i, i + 1] along x, where the emission rises by (2 i + 1) / 100 a mm.
glm::dvec3 in_cell(int i, double part) { return {i + part - 5.0, 0.2, 0.1}; }

TEST(PictureWeight, CountsErrorsByTheInverseRootOfTheSlope) {
  const Volume volume = growing_slope();
  const TrilinearField field(volume);
  const LevelField off_level(field, kWindow, 0.3);
  const PictureWeight weighted(off_level, 0.09, 1.0);
  for (int i = 0; i < 10; ++i) {
    const glm::dvec3 p = in_cell(i, 0.3);
    const double slope = (2.0 * i + 1.0) / 100.0;
    const double weight = 3.0 * std::sqrt(0.09 / slope);
    const FieldSample plain = off_level(p);
    const FieldSample counted = weighted(p);
    EXPECT_NEAR(counted.error, weight * plain.error, 1e-9) << "cell " << i;
    EXPECT_NEAR(counted.gradient.x, weight * slope, 1e-9) << "cell " << i;
  }
}

TEST(PictureWeight, NoErrorCountsLessThanItIsNorMoreThanNineTimes) {
  const Volume volume = growing_slope();
  const TrilinearField field(volume);
  const LevelField off_level(field, kWindow, 0.3);
  const glm::dvec3 p = in_cell(4, 0.5);  // 0.09 a mm
  const double error = off_level(p).error;
  EXPECT_DOUBLE_EQ(PictureWeight(off_level, 1e-3, 1.0)(p).error, error);
  EXPECT_DOUBLE_EQ(PictureWeight(off_level, 9.0, 1.0)(p).error, 9.0 * error);
  EXPECT_DOUBLE_EQ(PictureWeight(off_level, 0.0, 1.0)(p).error, error) << "no slope to go by";
}

// What keeps a surface's own error within its tolerance, or within what it was.
TEST(PictureWeight, WhatIsBeyondTheToleranceCountsMoreThanAllWithin) {
  constexpr double kTolerance = 0.2;
  const Volume volume = testing::random_volume<float>({8, 8, 8}, 0.0, 100.0);
  const TrilinearField field(volume);
  const LevelField off_level(field, kWindow, 0.5);
  const PictureWeight weighted(off_level, 0.3, kTolerance);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> along(-3.4, 3.4);
  double most_within = 0.0;
  double least_beyond = 1e9;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 p(along(random), along(random), along(random));
    const double error = std::abs(off_level(p).error);
    const double counted = std::abs(weighted(p).error);
    EXPECT_GE(counted, error);
    if (error > kTolerance) {
      EXPECT_DOUBLE_EQ(counted, 9.0 * error);
      least_beyond = std::min(least_beyond, counted);
    } else {
      most_within = std::max(most_within, counted);
    }
  }
  EXPECT_LT(most_within, least_beyond);
}

TEST(PictureWeight, TheMeanSlopeIsThatOfTheAreaThatMayMove) {
  // A ball's emission falls by 0.05 a mm; its contour is cut off by the volume's border.
  const Volume ball = testing::volume_of<float>({20, 20, 20}, [](auto i, auto j, auto k) {
    return 100.0 - 5.0 * glm::length(glm::dvec3(i, j, k) - glm::dvec3(9.5, 9.5, 4.0));
  });
  const TrilinearField field(ball);
  const std::vector<double> values{60.0};
  const TriangleMesh surface = extract_surfaces(ball, values).front();
  EXPECT_NEAR(mean_slope(surface, LevelField(field, kWindow, 0.6)), 0.05, 0.002);
  EXPECT_EQ(mean_slope({}, LevelField(field, kWindow, 0.6)), 0.0);
}

}  // namespace
}  // namespace nacre

#include "shells/placement.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::volume_of;

std::vector<double> evenly(std::size_t count, double lo, double hi) {
  std::vector<double> emissions(count);
  for (std::size_t i = 0; i < count; ++i) {
    emissions[i] = lo + (hi - lo) * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
  }
  return emissions;
}

// Evenly spread pixels on (0, 1], the lowest layer shown as 0: layers of width w above one of width
// w / 2 (the level lies in the middle between 0 and r_1): t_k = (2 k - 1) / (2 n + 1), r_k = 2 k /
// (2 n + 1).
TEST(Placement, OfEvenlySpreadPixelsIsEven) {
  const MaximumHistogram histogram = make_histogram(evenly(20000, 0.0, 1.0));
  const std::size_t n = 6;
  const std::vector<Level> levels = optimal_levels(histogram, n);
  ASSERT_EQ(levels.size(), n);
  for (std::size_t k = 0; k < n; ++k) {
    const double width = 2.0 / (2.0 * n + 1.0);
    EXPECT_NEAR(levels[k].emission, (static_cast<double>(k) + 0.5) * width, 2e-3) << k;
    EXPECT_NEAR(levels[k].representative, (static_cast<double>(k) + 1.0) * width, 2e-3) << k;
  }
  // n full layers of variance w^2 / 12, half a layer at the mean square of an even spread to w / 2.
  const double width = 2.0 / 13.0;
  EXPECT_NEAR(predicted_error(levels, histogram), width * width / 12.0, 1e-5);
}

TEST(Placement, OfFewEmissionsHasNoError) {
  const MaximumHistogram histogram =
      make_histogram({0.2, 0.2, 0.5, 0.9, 0.9, 0.9, 0.0, 0.0});  // 0 is not lit
  const std::vector<Level> levels = optimal_levels(histogram, 10);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_DOUBLE_EQ(levels[0].representative, 0.2);
  EXPECT_DOUBLE_EQ(levels[0].emission, 0.1);
  EXPECT_DOUBLE_EQ(levels[1].representative, 0.5);
  EXPECT_DOUBLE_EQ(levels[1].emission, 0.35);
  EXPECT_DOUBLE_EQ(levels[2].representative, 0.9);
  EXPECT_DOUBLE_EQ(*levels[0].sum_representative, 0.225);
  EXPECT_DOUBLE_EQ(*levels[2].sum_representative, 1.0);
  EXPECT_NEAR(predicted_error(levels, histogram), 0.0, 1e-15);
}

/// The least squared error of sorted values in `count` runs about their means after one run shown
/// as 0: every choice of splits.
double exhaustive(const std::vector<double>& values, std::size_t begin, std::size_t count) {
  if (count == 0) return begin == values.size() ? 0.0 : 1e9;
  double best = 1e9;
  for (std::size_t end = begin + 1; end <= values.size(); ++end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += values[i];
    const double mean = sum / static_cast<double>(end - begin);
    double cost = 0.0;
    for (std::size_t i = begin; i < end; ++i) cost += (values[i] - mean) * (values[i] - mean);
    best = std::min(best, cost + exhaustive(values, end, count - 1));
  }
  return best;
}

TEST(Placement, IsTheBestOfAllChoices) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.01, 1.0);
  for (int trial = 0; trial < 10; ++trial) {
    std::vector<double> values(9);
    for (double& value : values) value = std::pow(unit(random), 2.0);
    std::sort(values.begin(), values.end());
    double best = 1e9;
    double zeros = 0.0;
    for (std::size_t begin = 0; begin < values.size(); ++begin) {
      best = std::min(best, zeros + exhaustive(values, begin, 3));
      zeros += values[begin] * values[begin];
    }
    const MaximumHistogram histogram = make_histogram(values);
    EXPECT_NEAR(predicted_error(optimal_levels(histogram, 3), histogram) * 9.0, best, 1e-9);
  }
}

TEST(Placement, NeverLosesAgainstUniformLevels) {
  std::mt19937 random(9);
  std::normal_distribution<double> bell(0.2, 0.03);
  std::vector<double> values(5000);
  for (double& value : values) value = std::clamp(bell(random), 1e-6, 1.0);
  const MaximumHistogram histogram = make_histogram(values);
  for (const std::size_t n : {1u, 5u, 24u, 100u}) {
    EXPECT_LE(predicted_error(optimal_levels(histogram, n), histogram),
              predicted_error(uniform_levels(n), histogram) + 1e-12)
        << n;
  }
}

TEST(Placement, LevelsAscendAndShowWhatIsInTheirLayer) {
  const MaximumHistogram histogram = make_histogram(evenly(1000, 0.3, 0.31));
  const std::vector<Level> levels = optimal_levels(histogram, 40);
  double below = 0.0;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    EXPECT_GT(levels[k].emission, below);
    EXPECT_GE(levels[k].representative, levels[k].emission);
    const double next = k + 1 < levels.size() ? levels[k + 1].emission : 1.0;
    EXPECT_LE(levels[k].representative, next);
    below = levels[k].emission;
  }
}

TEST(Placement, OfADarkVolumeIsUniform) {
  const std::vector<Level> levels = optimal_levels(make_histogram({0.0, 0.0}), 4);
  ASSERT_EQ(levels.size(), 4u);
  EXPECT_DOUBLE_EQ(levels[0].emission, 0.125);
  EXPECT_THROW(optimal_levels(make_histogram({0.5}), 0), Error);
}

TEST(Placement, ListedLevelsShowTheMeanOfTheirLayer) {
  const MaximumHistogram histogram = make_histogram({0.25, 0.3, 0.3, 0.9});
  const std::vector<Level> levels =
      with_mean_representatives(explicit_levels(std::vector<double>{0.2, 0.5, 0.8}), histogram);
  EXPECT_DOUBLE_EQ(levels[0].representative, 0.85 / 3.0);
  EXPECT_DOUBLE_EQ(*levels[0].sum_representative, 0.35);
  EXPECT_DOUBLE_EQ(levels[1].representative, 0.65);  // no pixel: the middle
  EXPECT_DOUBLE_EQ(levels[2].representative, 0.9);
  EXPECT_DOUBLE_EQ(*levels[2].sum_representative, 1.0);
}

// A bright ball in a grey one: every maximum projection shows two emissions.
TEST(MaximumHistogramTest, OfTwoBallsHasTheirEmissionsFromAllDirections) {
  const Volume volume = volume_of<std::uint8_t>({24, 24, 24}, [](auto x, auto y, auto z) {
    const double r = std::hypot(static_cast<double>(x) - 11.5, static_cast<double>(y) - 11.5,
                                static_cast<double>(z) - 11.5);
    return r < 4.0 ? 200 : r < 9.0 ? 80 : 0;
  });
  const ExactWalk walk(volume, EmissionMap::window(0, 200));
  const BoundingSphere sphere = bounding_sphere(volume.dims, volume.world_from_voxel);
  const HistogramOptions options{.directions = 6, .size = 48};
  const MaximumHistogram histogram = maximum_histogram(walk, sphere, options);
  double all = 0.0;
  double plain = 0.0;
  for (const ValueGroup& group : histogram.groups) {
    all += group.count;
    if (std::abs(group.least - 0.4) < 0.02 || group.least > 0.98) plain += group.count;
  }
  EXPECT_GT(plain, 0.5 * all);
  const std::vector<Level> levels = optimal_levels(histogram, 2);
  EXPECT_NEAR(levels[0].representative, 0.4, 0.08);
  EXPECT_NEAR(levels[1].representative, 0.95, 0.08);

  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const MaximumHistogram single = maximum_histogram(walk, sphere, options);
  ASSERT_EQ(single.groups.size(), histogram.groups.size());
  EXPECT_EQ(single.groups.back().sum, histogram.groups.back().sum);
}

}  // namespace
}  // namespace nacre

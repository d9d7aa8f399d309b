#include "extract/stored_levels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "extract/sample_classes.h"

namespace nacre {
namespace {

/// The class by its definition.
template <class T>
std::size_t counted_class(T sample, const std::vector<double>& values, double slope,
                          double intercept) {
  std::size_t count = 0;
  for (const double v : values) {
    if (slope * static_cast<double>(sample) + intercept >= v) ++count;
  }
  return count;
}

template <class T>
class SampleClassesOf : public ::testing::Test {};
using StoredTypes = ::testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t,
                                     std::uint32_t, std::int32_t, float, double>;
TYPED_TEST_SUITE(SampleClassesOf, StoredTypes);

TYPED_TEST(SampleClassesOf, AreTheNumbersOfValuesReached) {
  using T = TypeParam;
  std::mt19937 random(9);
  const std::vector<double> values{-90.25, -3.0, 0.0, 0.1, std::nextafter(0.1, 1.0),
                                   7.0,    55.5, 1e9};
  for (const double slope : {1.0, -1.0, 0.37, -6.5}) {
    const double intercept = slope < 0.0 ? 12.3 : -1.7;
    const auto levels = stored_levels<T>(values, slope, intercept);
    const SampleClasses<T> classes(levels);
    std::vector<T> row(200);
    for (T& sample : row) sample = static_cast<T>(random() % 100);
    std::vector<std::uint8_t> found(row.size());
    std::vector<ClassRange> bricks(brick_count(row.size()));
    classes.of_row(row, found.data(), bricks.data());
    for (std::size_t i = 0; i < row.size(); ++i) {
      EXPECT_EQ(found[i], counted_class(row[i], values, slope, intercept));
      EXPECT_EQ(found[i], classes.of(row[i]));
      if (i < row.size() - 1) {
        EXPECT_LE(bricks[i / kBrickCells].lo, found[i]);
        EXPECT_GE(bricks[i / kBrickCells].hi, found[i]);
      }
    }
  }
}

// Few values are counted, many looked up; bricks that keep to one class are not looked at sample by
// sample.
TYPED_TEST(SampleClassesOf, OfManyValuesAndOfBricksInOneClass) {
  using T = TypeParam;
  std::mt19937 random(3);
  for (const int count : {1, 19, 20, 21, 30, 60}) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(5.5 + 1.5 * i);
    const auto levels = stored_levels<T>(values, 1.0, 0.0);
    const SampleClasses<T> classes(levels);
    std::vector<T> row(1 + 6 * kBrickCells);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::size_t brick = i / kBrickCells;
      const unsigned spread = brick % 2 == 0 ? 2 : 100;  // none or all of the values between
      row[i] = static_cast<T>(brick * 10 + random() % spread);
    }
    std::vector<std::uint8_t> found(row.size());
    std::vector<ClassRange> bricks(brick_count(row.size()));
    classes.of_row(row, found.data(), bricks.data());
    for (std::size_t i = 0; i < row.size(); ++i) {
      ASSERT_EQ(found[i], counted_class(row[i], values, 1.0, 0.0)) << count << ' ' << i;
    }
  }
}

TYPED_TEST(SampleClassesOf, AreExactBesideAThreshold) {
  using T = TypeParam;
  const std::vector<double> values{10.0};
  for (const double slope : {0.1, -0.1, 1.0 / 3.0}) {
    const auto levels = stored_levels<T>(values, slope, 1.0);
    if (levels.thresholds.empty()) continue;
    const T threshold = levels.thresholds[0];
    const bool inside = slope * static_cast<double>(threshold) + 1.0 >= 10.0;
    EXPECT_EQ(inside, slope > 0.0);
    EXPECT_LE(levels.crossings[0], static_cast<double>(threshold));
  }
}

TEST(StoredLevels, LeaveOutValuesThatNoSampleReaches) {
  const std::array values{-5.0, 0.0, 254.5, 255.0, 255.5, 1000.0};
  EXPECT_EQ(stored_levels<std::uint8_t>(values, 1.0, 0.0).count, 4u);
  EXPECT_EQ(stored_levels<std::uint8_t>(values, -1.0, 0.0).count, 2u);
}

}  // namespace
}  // namespace nacre

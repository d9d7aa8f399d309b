#include "extract/default_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "extract/sample_ranks.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::random_volume;
using testing::volume_of;

template <class T>
void expect_ranks_of_a_sort(double lo, double hi, double slope) {
  Volume volume = random_volume<T>({11, 7, 5}, lo, hi);
  volume.slope = slope;
  volume.intercept = 3.0;
  std::vector<double> values;
  for (const T sample : samples_as<T>(static_cast<const Volume&>(volume))) {
    values.push_back(slope * static_cast<double>(sample) + 3.0);
  }
  std::sort(values.begin(), values.end());
  const SampleRanks ranks(volume);
  for (const std::uint64_t rank : {0, 1, 100, 192, 384}) {
    EXPECT_EQ(ranks.value_at(rank), values[rank]) << name(volume.type);
  }
  EXPECT_EQ(ranks.count_of_least(),
            static_cast<std::uint64_t>(std::count(values.begin(), values.end(), values[0])));
}

TEST(SampleRanks, AreThoseOfASortInEveryStoredType) {
  for (const double slope : {1.0, -0.5}) {
    expect_ranks_of_a_sort<std::uint8_t>(0, 255, slope);
    expect_ranks_of_a_sort<std::int8_t>(-128, 127, slope);
    expect_ranks_of_a_sort<std::uint16_t>(0, 65535, slope);
    expect_ranks_of_a_sort<std::int16_t>(-32768, 32767, slope);
    expect_ranks_of_a_sort<std::uint32_t>(0, 4294967295.0, slope);
    expect_ranks_of_a_sort<std::int32_t>(-2147483648.0, 2147483647.0, slope);
    expect_ranks_of_a_sort<float>(-1e30, 1e30, slope);
    expect_ranks_of_a_sort<double>(-1.0, 1.0, slope);
  }
}

TEST(DefaultWindow, DarkensTissueAndSaturatesNextToNothing) {
  // Normal tissue 100 +- 10, and 2 percent of vessels from 200 to 1000.
  std::mt19937 random(3);
  std::normal_distribution<double> tissue(100.0, 10.0);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Volume volume = volume_of<float>({60, 60, 60}, [&](auto, auto, auto) {
    return unit(random) < 0.02 ? 200.0 + 800.0 * unit(random) : tissue(random);
  });
  const Window window = default_window(volume);
  EXPECT_NEAR(window.lo, 131.0, 3.0);
  EXPECT_NEAR(window.hi, 980.0, 15.0);
  volume.slope = 2.0;
  volume.intercept = -50.0;
  EXPECT_NEAR(default_window(volume).lo, 2.0 * window.lo - 50.0, 1e-9);
}

TEST(DefaultWindow, TakesARemovedBackgroundForWhatItIs) {
  const Volume volume = volume_of<std::uint8_t>({50, 50, 50}, [](auto x, auto y, auto) {
    return x == 25 && y == 25 ? 200 : 0;  // 1 voxel in 2500 is above 0
  });
  const Window window = default_window(volume);
  EXPECT_NEAR(window.lo, 16.0, 1e-12);
  EXPECT_EQ(window.hi, 200.0);
}

TEST(DefaultWindow, IsNeverEmpty) {
  for (const double value : {0.0, -5.0, 1e-300, 1.7e308, -1.7e308}) {
    const Volume constant = volume_of<double>({3, 3, 3}, [=](auto, auto, auto) { return value; });
    const Window window = default_window(constant);
    EXPECT_LT(window.lo, window.hi) << value;
  }
  const Volume one = volume_of<std::int16_t>({1, 1, 1}, [](auto, auto, auto) { return -7; });
  EXPECT_LT(default_window(one).lo, default_window(one).hi);
  // Nearly all at the greatest value; two values a hair apart.
  const Volume high =
      volume_of<float>({9, 9, 9}, [](auto x, auto, auto) { return x == 0 ? 0 : 1; });
  EXPECT_LT(default_window(high).lo, default_window(high).hi);
  const Volume hair = volume_of<double>(
      {9, 9, 9}, [](auto x, auto, auto) { return x == 0 ? 1.0 : std::nextafter(1.0, 2.0); });
  EXPECT_LT(default_window(hair).lo, default_window(hair).hi);
}

}  // namespace
}  // namespace nacre

#include "core/emission.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

namespace nacre {
namespace {

TEST(EmissionMap, WindowIsLinearAndClamped) {
  const EmissionMap map = EmissionMap::window(20.0, 220.0);
  EXPECT_EQ(map(-1e9), 0.0);
  EXPECT_EQ(map(20.0), 0.0);
  EXPECT_DOUBLE_EQ(map(70.0), 0.25);
  EXPECT_EQ(map(220.0), 1.0);
  EXPECT_EQ(map(1e9), 1.0);
}

TEST(EmissionMap, LevelIsTheLeastValueThatReachesIt) {
  const EmissionMap map =
      EmissionMap::piecewise_linear({{0.0, 0.0}, {10.0, 0.5}, {20.0, 0.5}, {30.0, 1.0}});
  EXPECT_DOUBLE_EQ(map.value_at(0.25), 5.0);
  EXPECT_DOUBLE_EQ(map.value_at(0.5), 10.0);  // not 20: the plateau starts at 10
  EXPECT_DOUBLE_EQ(map.value_at(0.75), 25.0);
  EXPECT_DOUBLE_EQ(map.value_at(1.0), 30.0);
  EXPECT_THROW(map.value_at(0.0), Error);
  EXPECT_THROW(map.value_at(1.5), Error);
}

TEST(EmissionMap, TakesTheWholeRangeOfDoubles) {
  const double most = std::numeric_limits<double>::max();
  const EmissionMap map = EmissionMap::window(-most, most);
  EXPECT_NEAR(map(0.0), 0.5, 1e-15);
  EXPECT_NEAR(map(0.5 * most), 0.75, 1e-15);
  EXPECT_NEAR(map.value_at(0.75) / most, 0.5, 1e-15);
}

TEST(EmissionMap, TakesAWindowOfOneUlp) {
  const double lo = 1.0;
  const double hi = std::nextafter(lo, 2.0);
  const EmissionMap map = EmissionMap::window(lo, hi);
  EXPECT_EQ(map(lo), 0.0);
  EXPECT_EQ(map(hi), 1.0);
}

TEST(EmissionMap, RefusesWhatIsNoRisingMap) {
  EXPECT_THROW(EmissionMap::window(5.0, 5.0), Error);
  EXPECT_THROW(EmissionMap::window(5.0, std::nan("")), Error);
  EXPECT_THROW(EmissionMap::piecewise_linear({{0.0, 0.0}}), Error);
  EXPECT_THROW(EmissionMap::piecewise_linear({{0.0, 0.5}, {1.0, 0.2}}), Error);
  EXPECT_THROW(EmissionMap::piecewise_linear({{0.0, 0.0}, {0.0, 1.0}}), Error);
  EXPECT_THROW(EmissionMap::piecewise_linear({{0.0, 0.0}, {1.0, 1.5}}), Error);
  EXPECT_THROW(EmissionMap::piecewise_linear({{0.0, 0.5}, {1.0, 0.5}}), Error);
}

}  // namespace
}  // namespace nacre

#include "report/spread.h"

#include <gtest/gtest.h>

namespace nacre {
namespace {

TEST(Spread, IsMedianAndQuartiles) {
  const Spread five = spread_of({5.0, 1.0, 4.0, 2.0, 3.0});
  EXPECT_EQ(five.median, 3.0);
  EXPECT_EQ(five.lower, 2.0);
  EXPECT_EQ(five.upper, 4.0);
  EXPECT_EQ(five.samples, 5);
  EXPECT_EQ(spread_of({1.0, 2.0}).median, 1.5);
}

TEST(Spread, OneSampleIsItsOwnAndNoneIsNone) {
  EXPECT_EQ(spread_of({7.0}).lower, 7.0);
  EXPECT_EQ(spread_of({7.0}).upper, 7.0);
  EXPECT_EQ(spread_of({}).samples, 0);
}

}  // namespace
}  // namespace nacre

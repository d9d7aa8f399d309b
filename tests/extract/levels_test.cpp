#include "extract/levels.h"

#include <gtest/gtest.h>

#include <array>

#include "core/error.h"

namespace nacre {
namespace {

TEST(Levels, UniformOnesFollowTheMidpointRule) {
  const auto levels = uniform_levels(4);
  ASSERT_EQ(levels.size(), 4u);
  EXPECT_EQ(levels[0].emission, 0.125);
  EXPECT_EQ(levels[0].representative, 0.25);
  EXPECT_EQ(levels[3].emission, 0.875);
  EXPECT_EQ(levels[3].representative, 1.0);
  EXPECT_THROW(uniform_levels(0), Error);
}

TEST(Levels, ExplicitOnesShowTheMiddlesOfTheirLayers) {
  const auto levels = explicit_levels(std::array{0.25, 0.5, 1.0});
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[0].representative, 0.375);
  EXPECT_EQ(levels[1].representative, 0.75);
  EXPECT_EQ(levels[2].representative, 1.0);
}

TEST(Levels, RefusesWhatIsNoAscendingListOfEmissions) {
  EXPECT_THROW(explicit_levels({}), Error);
  EXPECT_THROW(explicit_levels(std::array{0.0, 0.5}), Error);
  EXPECT_THROW(explicit_levels(std::array{0.5, 1.1}), Error);
  EXPECT_THROW(explicit_levels(std::array{0.5, 0.5}), Error);
}

}  // namespace
}  // namespace nacre

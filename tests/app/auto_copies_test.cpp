// When a build makes coarse copies that nobody asked for, and when it leaves them out again.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "app/set_building.h"

namespace nacre {
namespace {

/// How `--coarse auto` wants copies of so many levels within a tolerance.
BuildOptions automatic(std::size_t levels, double tolerance, const std::string& weight = {}) {
  ShellFlags flags;
  flags.coarse = kAutoCopies;
  flags.tolerance = tolerance;
  flags.tolerance_weight = weight;
  return build_options(flags, glm::dmat4(1.0), {uniform_levels(levels), "uniform"}, {});
}

TEST(AutoCopies, AreTwoLayersOffAndOfManyTrianglesOnly) {
  EXPECT_DOUBLE_EQ(automatic(24, 0.01).coarse_tolerance, 2.0 / 24.0);
  EXPECT_DOUBLE_EQ(automatic(4, 0.01).coarse_tolerance, 0.25);  // no more
  EXPECT_EQ(automatic(24, 0.01).coarse_above_triangles, 200'000u);
}

TEST(AutoCopies, AreMadeOfShellsAThirdAsFarOffAtMost) {
  EXPECT_GT(automatic(24, 0.027).coarse_tolerance, 0.0);
  EXPECT_EQ(automatic(24, 0.028).coarse_tolerance, 0.0);
  EXPECT_EQ(automatic(24, 0.0).coarse_tolerance, 0.0);  // not simplified
  // Weighted shells use up a third of theirs at the mean slope.
  EXPECT_GT(automatic(24, 0.08, kPictureWeight).coarse_tolerance, 0.0);
  EXPECT_EQ(automatic(24, 0.084, kPictureWeight).coarse_tolerance, 0.0);
}

TEST(AutoCopies, AreNotMadeWhereNoneOrOneToleranceIsAskedFor) {
  ShellFlags flags;
  flags.tolerance = 0.01;
  const auto tolerance = [&](const char* coarse) {
    flags.coarse = coarse;
    return build_options(flags, glm::dmat4(1.0), {uniform_levels(24), "uniform"}, {})
        .coarse_tolerance;
  };
  EXPECT_EQ(tolerance(kNoCopies), 0.0);
  EXPECT_DOUBLE_EQ(tolerance("0.2"), 0.2);
}

/// A set of two shells of 500 bytes each, with copies of so many in all.
CompressedSet with_copies(std::size_t bytes) {
  CompressedSet set;
  set.shells.resize(2);
  for (CompressedShell& shell : set.shells) shell.bytes.resize(500);
  set.coarse.emplace();
  set.coarse->shells.resize(2);
  set.coarse->shells[0].bytes.resize(bytes);
  return set;
}

TEST(AutoCopies, AreLeftOutWhereTheyTakeMoreThanThreeTenths) {
  CommonFlags flags;
  flags.quiet = true;
  Reporter reporter(flags);
  CompressedSet kept = with_copies(300);
  drop_large_copies(kept, reporter);
  EXPECT_TRUE(kept.coarse);
  CompressedSet dropped = with_copies(301);
  drop_large_copies(dropped, reporter);
  EXPECT_FALSE(dropped.coarse);
  drop_large_copies(dropped, reporter);  // nothing to drop
  EXPECT_FALSE(dropped.coarse);
}

}  // namespace
}  // namespace nacre

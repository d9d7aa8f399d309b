#include "core/progress.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

namespace nacre {
namespace {

TEST(ProgressMeter, RisesFromZeroToOneWithManyThreads) {
  std::vector<double> told;
  const ProgressCallback callback = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "walk");
    told.push_back(fraction);
  };
  {
    ProgressMeter meter(callback, "walk", 4000);
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        for (int step = 0; step < 1000; ++step) meter.advance();
      });
    }
  }
  ASSERT_GE(told.size(), 2u);
  EXPECT_EQ(told.front(), 0.0);
  EXPECT_EQ(told.back(), 1.0);
  for (std::size_t i = 1; i < told.size(); ++i) EXPECT_LE(told[i - 1], told[i]);
  EXPECT_LE(told.size(), 103u);
}

TEST(ProgressMeter, TakesAnEmptyCallback) {
  ProgressMeter meter({}, "walk", 0);
  meter.advance(5);
}

}  // namespace
}  // namespace nacre

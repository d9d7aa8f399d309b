#include "report/error_split.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/expect_error.h"

namespace nacre {
namespace {

Image picture_of(std::vector<float> pixels) {
  return {static_cast<int>(pixels.size()), 1, std::move(pixels)};
}

TEST(ErrorSplit, IsThatOfItsDefinition) {
  const Image truth = picture_of({0.0f, 0.5f, 1.0f, 0.0f});
  const ErrorSplit split =
      split_error(truth, std::vector<ErrorStage>{{"a", picture_of({0.0f, 0.75f, 1.0f, 0.25f})},
                                                 {"b", picture_of({0.0f, 0.75f, 0.5f, 0.0f})}});
  // d_a = (0, 1/4, 0, 1/4), d_b = (0, 0, -1/2, -1/4), D = (0, 1/4, -1/2, 0): <D, D> = 5/16.
  ASSERT_EQ(split.parts.size(), 2u);
  EXPECT_EQ(split.parts[0].cause, "a");
  EXPECT_DOUBLE_EQ(split.parts[0].share, 0.2);
  EXPECT_DOUBLE_EQ(split.parts[1].share, 0.8);
  EXPECT_EQ(split.dominant, 1u);
  EXPECT_DOUBLE_EQ(split.parts[0].rmse, std::sqrt(2.0 / 16 / 4));
  EXPECT_DOUBLE_EQ(split.parts[0].rmse_lit, std::sqrt(1.0 / 16 / 2));
  EXPECT_DOUBLE_EQ(split.parts[1].max_error, 0.5);
  EXPECT_DOUBLE_EQ(split.parts[1].bias, -0.75 / 4);
  EXPECT_DOUBLE_EQ(split.total.rmse, std::sqrt(5.0 / 16 / 4));
  EXPECT_DOUBLE_EQ(split.total.share, 1.0);
}

TEST(ErrorSplit, SharesAddUpWhateverTheCausesDo) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(0.0f, 1.0f);
  const auto drawn = [&] {
    std::vector<float> pixels(1000);
    for (float& pixel : pixels) pixel = value(random);
    return picture_of(std::move(pixels));
  };
  const Image truth = drawn();
  std::vector<ErrorStage> stages;
  for (int i = 0; i < 5; ++i) stages.push_back({"cause", drawn()});
  const ErrorSplit split = split_error(truth, stages);
  double shares = 0.0;
  double bias = 0.0;
  for (const ErrorPart& part : split.parts) {
    shares += part.share;
    bias += part.bias;
  }
  EXPECT_NEAR(shares, 1.0, 1e-13);
  EXPECT_NEAR(bias, split.total.bias, 1e-13);
}

TEST(ErrorSplit, ACauseThatUndoesAnotherHasANegativeShare) {
  const Image truth = picture_of({0.0f, 1.0f});
  const ErrorSplit split = split_error(
      truth, std::vector<ErrorStage>{{"off", picture_of({4, 1})}, {"back", picture_of({1, 1})}});
  EXPECT_DOUBLE_EQ(split.parts[0].share, 4.0);
  EXPECT_DOUBLE_EQ(split.parts[1].share, -3.0);
  EXPECT_EQ(split.dominant, 0u);
}

TEST(ErrorSplit, EqualPicturesHaveNoError) {
  const Image truth = picture_of({0.5f, 1.0f});
  const ErrorSplit split = split_error(truth, std::vector<ErrorStage>{{"none", truth}});
  EXPECT_EQ(split.total.rmse, 0.0);
  EXPECT_EQ(split.parts[0].share, 0.0);
}

TEST(ErrorSplit, RefusesOtherSizes) {
  const Image truth = picture_of({0.5f, 1.0f});
  testing::expect_error(ErrorCode::BadArgument, "3 x 1", [&] {
    split_error(truth, std::vector<ErrorStage>{{"large", picture_of({1, 2, 3})}});
  });
  testing::expect_error(ErrorCode::BadArgument, "no picture", [&] { split_error(truth, {}); });
}

}  // namespace
}  // namespace nacre

#include "report/picture_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace nacre {
namespace {

Image picture_of(std::vector<float> pixels, int width) {
  return {width, static_cast<int>(pixels.size()) / width, std::move(pixels)};
}

TEST(PictureError, IsThatOfItsDefinition) {
  const Image truth = picture_of({0.0f, 0.5f, 1.0f, 0.0f}, 2);
  const Image picture = picture_of({0.1f, 0.5f, 0.7f, 0.0f}, 2);
  const PictureComparison found = compare_pictures(picture, truth, 1.0);
  EXPECT_EQ(found.all.pixels, 4u);
  EXPECT_NEAR(found.all.rmse, std::sqrt((0.01 + 0.09) / 4), 1e-7);
  EXPECT_NEAR(found.all.psnr_db, -20 * std::log10(std::sqrt(0.1 / 4)), 1e-5);
  EXPECT_NEAR(found.all.max_error, 0.3, 1e-7);
  EXPECT_NEAR(found.all.bias, -0.2 / 4, 1e-7);
  EXPECT_EQ(found.lit.pixels, 2u);  // where the truth shows anything
  EXPECT_NEAR(found.lit.rmse, std::sqrt(0.09 / 2), 1e-7);
  EXPECT_EQ(found.worst_x, 0);
  EXPECT_EQ(found.worst_y, 1);
}

TEST(PictureError, EqualPicturesHaveInfinitePsnr) {
  const Image truth = picture_of({0.0f, 0.5f}, 2);
  const PictureComparison found = compare_pictures(truth, truth, 1.0);
  EXPECT_TRUE(std::isinf(found.all.psnr_db));
  EXPECT_EQ(found.lit.max_error, 0.0);
  const PictureComparison dark = compare_pictures(picture_of({0, 0}, 2), picture_of({0, 0}, 2), 1);
  EXPECT_EQ(dark.lit.pixels, 0u);
}

TEST(PictureError, PsnrIsRelativeToThePeak) {
  const Image truth = picture_of({10.0f, 100.0f}, 2);
  const Image picture = picture_of({11.0f, 99.0f}, 2);
  EXPECT_NEAR(compare_pictures(picture, truth, 100.0).all.psnr_db, 40.0, 1e-9);
}

TEST(PictureError, DifferenceIsSignedAndAmplified) {
  const Image error =
      difference(picture_of({0.6f, 0.4f, 0.5f}, 3), picture_of({0.5f, 0.5f, 0.5f}, 3));
  EXPECT_NEAR(error.pixels[0], 0.1, 1e-7);
  EXPECT_NEAR(error.pixels[1], -0.1, 1e-7);
  const DisplayImage shown = difference_picture(error, 5.0);
  EXPECT_NEAR(shown.pixels[0], 32768, 2);  // red: too bright
  EXPECT_EQ(shown.pixels[2], 0);
  EXPECT_EQ(shown.pixels[3], 0);
  EXPECT_NEAR(shown.pixels[5], 32768, 2);  // blue: too dark
  EXPECT_EQ(shown.pixels[6] + shown.pixels[7] + shown.pixels[8], 0);
}

TEST(PictureError, RefusesOtherSizesAndPeaks) {
  const Image a = picture_of({1, 2}, 2);
  EXPECT_THROW(compare_pictures(a, picture_of({1, 2}, 1), 1.0), Error);
  EXPECT_THROW(compare_pictures(a, a, 0.0), Error);
  EXPECT_THROW(difference(a, picture_of({1, 2}, 1)), Error);
}

}  // namespace
}  // namespace nacre

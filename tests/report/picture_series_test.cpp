#include "report/picture_series.h"

#include <gtest/gtest.h>

#include <vector>

#include "report/picture_error.h"
#include "tests/support/expect_error.h"

namespace nacre {
namespace {

Image flat(int width, int height, float value) {
  Image image = make_image(width, height);
  for (float& pixel : image.pixels) pixel = value;
  return image;
}

TEST(PictureSeries, ErrorIsThatOfAllPixelsTogether) {
  const std::vector<Image> truth{flat(4, 3, 0.5F), flat(4, 3, 0.5F)};
  const std::vector<Image> views{flat(4, 3, 0.5F), flat(4, 3, 0.75F)};
  const PictureComparison both = compare_pictures(stacked(views), stacked(truth), 1.0);
  EXPECT_EQ(both.all.pixels, 24U);
  // Half of the pixels are off by 1/4: the mean square is 1/32.
  EXPECT_DOUBLE_EQ(both.all.rmse * both.all.rmse, 1.0 / 32.0);
  EXPECT_EQ(both.worst_y, 3) << "the second view is below the first";
}

TEST(PictureSeries, RefusesNoneAndUnequalOnes) {
  testing::expect_error(ErrorCode::BadArgument, "expected at least one", [] { stacked({}); });
  const std::vector<Image> unequal{flat(4, 3, 0.0F), flat(4, 2, 0.0F)};
  testing::expect_error(ErrorCode::BadArgument, "one size", [&] { stacked(unequal); });
}

}  // namespace
}  // namespace nacre

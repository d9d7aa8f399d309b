#include "report/markup.h"

#include <gtest/gtest.h>

namespace nacre {
namespace {

TEST(Markup, Base64IsThatOfRfc4648) {
  // Section 10 of the RFC.
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xfb\xff\xfe"), "+//+");
}

TEST(Markup, NamesOfFilesCannotBecomeMarkup) {
  EXPECT_EQ(escaped("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
}

TEST(Markup, ThumbnailIsTheMeanOfBlocks) {
  const DisplayImage picture{4, 2, 1, {0, 100, 7, 7, 200, 300, 7, 7}};
  const DisplayImage small = thumbnail(picture, 2);
  EXPECT_EQ(small.width, 2);
  EXPECT_EQ(small.height, 1);
  EXPECT_EQ(small.pixels, (std::vector<std::uint16_t>{150, 7}));
}

TEST(Markup, ThumbnailOfALineStaysInside) {
  const DisplayImage line{5, 1, 3, std::vector<std::uint16_t>(15, 9)};
  const DisplayImage small = thumbnail(line, 2);
  EXPECT_EQ(small.height, 1);
  for (const std::uint16_t value : small.pixels) EXPECT_EQ(value, 9);
}

TEST(Markup, LitPartHoldsWhatIsLit) {
  Image image = make_image(100, 50);
  image.at(40, 20) = 1.0F;
  image.at(60, 30) = 0.5F;
  const PictureCrop part = lit_part(image, 1.0);
  EXPECT_LE(part.x, 40);
  EXPECT_LE(part.y, 20);
  EXPECT_GT(part.x + part.width, 60);
  EXPECT_GT(part.y + part.height, 30);
  EXPECT_LT(part.width, 50);
  EXPECT_EQ(lit_part(make_image(9, 7), 1.0).width, 9) << "all of a dark picture";
}

TEST(Markup, CroppingKeepsPixelsAndChannels) {
  const DisplayImage picture{3,
                             2,
                             3,
                             {0, 1, 2, 10, 11, 12, 20, 21, 22,  //
                              30, 31, 32, 40, 41, 42, 50, 51, 52}};
  const DisplayImage part = cropped(picture, {1, 1, 2, 1});
  EXPECT_EQ(part.pixels, (std::vector<std::uint16_t>{40, 41, 42, 50, 51, 52}));
}

}  // namespace
}  // namespace nacre

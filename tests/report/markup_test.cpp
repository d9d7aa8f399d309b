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

}  // namespace
}  // namespace nacre

#include "render/display.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace nacre {
namespace {

Image row_of(std::vector<float> pixels) {
  return {static_cast<int>(pixels.size()), 1, std::move(pixels)};
}

TEST(Display, WindowIsLinearAndClamped) {
  const DisplayImage shown = display_picture(row_of({-1.0f, 0.2f, 0.4f, 0.6f, 9.0f}), {0.2, 0.6});
  EXPECT_EQ(shown.channels, 1);
  EXPECT_EQ(shown.pixels[0], 0);
  EXPECT_EQ(shown.pixels[1], 0);
  EXPECT_NEAR(shown.pixels[2], 32768, 1);
  EXPECT_EQ(shown.pixels[3], 65535);
  EXPECT_EQ(shown.pixels[4], 65535);
}

TEST(Display, EveryColourMapRisesFromItsDarkToItsBrightEnd) {
  for (const std::string_view name : color_map_names()) {
    const DisplayImage shown = display_picture(row_of({0.0f, 1.0f}), {}, name);
    const auto channels = static_cast<std::size_t>(shown.channels);
    ASSERT_EQ(shown.pixels.size(), 2 * channels);
    const bool inverted = name == "gray-inverted";
    for (std::size_t c = 0; c < channels; ++c) {
      EXPECT_EQ(shown.pixels[c], inverted ? 65535 : 0) << name;
      EXPECT_EQ(shown.pixels[channels + c], inverted ? 0 : 65535) << name;
    }
  }
}

TEST(Display, SumIsShownUpToItsLargestPixel) {
  EXPECT_EQ(default_display_window(row_of({3.0f, 7.0f}), PictureMode::Sum).hi, 7.0);
  EXPECT_EQ(default_display_window(row_of({0.0f}), PictureMode::Sum).hi, 1.0);
  EXPECT_EQ(default_display_window(row_of({0.3f}), PictureMode::Max).hi, 1.0);
}

TEST(Display, RefusesEmptyWindowsAndUnknownMaps) {
  EXPECT_THROW(display_picture(row_of({0.0f}), {1.0, 1.0}), Error);
  EXPECT_THROW(display_picture(row_of({0.0f}), {}, "jet"), Error);
}

}  // namespace
}  // namespace nacre

#include "render/display.h"

#include <gtest/gtest.h>

#include <algorithm>

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

TEST(Display, GrayMapsGiveGrayPicturesAndOthersRgb) {
  for (const std::string_view name : color_map_names()) {
    EXPECT_EQ(display_picture(row_of({0.0f, 1.0f}), {}, name).channels,
              name.starts_with("gray") ? 1 : 3)
        << name;
  }
  const Picture picture{row_of({0.0f, 1.0f}), std::nullopt};
  EXPECT_EQ(display_picture(picture, {.rgb = true}).pixels,
            (std::vector<std::uint16_t>{0, 0, 0, 65535, 65535, 65535}));
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

/// One row: pixels of the volume, and a tool of one colour behind those that `covered` says.
Picture with_tool(std::vector<float> pixels, std::vector<std::uint8_t> covered,
                  const glm::vec3& color) {
  Picture picture{row_of(std::move(pixels)), std::nullopt};
  picture.tools = make_tool_layer(picture.volume.width, 1);
  picture.tools->covered = std::move(covered);
  for (std::size_t i = 0; i < picture.tools->covered.size(); ++i) {
    if (picture.tools->covered[i] != 0) picture.tools->colors[i] = color;
  }
  return picture;
}

glm::dvec3 shown_color(float pixel, const glm::vec3& tool, const DisplayOptions& options) {
  const DisplayImage shown = display_picture(with_tool({pixel}, {1}, tool), options);
  EXPECT_EQ(shown.channels, 3);
  return glm::dvec3(shown.pixels.at(0), shown.pixels.at(1), shown.pixels.at(2)) / 65535.0;
}

void expect_shown(float pixel, const glm::vec3& tool, const DisplayOptions& options,
                  const glm::dvec3& expected) {
  const glm::dvec3 found = shown_color(pixel, tool, options);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1.0 / 65535.0) << c;
}

constexpr glm::vec3 kTool(0.25f, 0.5f, 0.75f);

TEST(DisplayTools, JoinAMaximumByTheBrighterOfEachChannel) {
  expect_shown(0.0f, kTool, {}, kTool);
  expect_shown(0.5f, kTool, {}, {0.5, 0.5, 0.75});
  expect_shown(1.0f, kTool, {}, {1.0, 1.0, 1.0});
}

TEST(DisplayTools, AreAddedToASumAndACount) {
  for (const PictureMode mode : {PictureMode::Sum, PictureMode::Count}) {
    expect_shown(0.0f, kTool, {.window = {0.0, 4.0}, .mode = mode}, kTool);
    expect_shown(1.0f, kTool, {.window = {0.0, 4.0}, .mode = mode}, {0.5, 0.75, 1.0});
    expect_shown(2.0f, kTool, {.window = {0.0, 4.0}, .mode = mode}, {0.75, 1.0, 1.0});
  }
  // Channels that a colour map leaves dark take nothing away.
  expect_shown(0.1f, kTool, {.color_map = "hot", .mode = PictureMode::Sum}, {0.55, 0.5, 0.75});
}

TEST(DisplayTools, AreReplacedByWhatIsSeenInFrontOfThem) {
  for (const PictureMode mode : {PictureMode::Max, PictureMode::Sum}) {
    const DisplayOptions over{.mode = mode, .blend = ToolBlend::Over};
    expect_shown(0.0f, kTool, over, kTool);
    expect_shown(0.1f, kTool, over, glm::dvec3(0.1f));
  }
  expect_shown(0.0f, kTool, {.mode = PictureMode::Iso}, kTool);
  expect_shown(0.1f, kTool, {.mode = PictureMode::Iso}, glm::dvec3(0.1f));
}

// Seen on the negative, the inverted picture is the picture.
TEST(DisplayTools, DarkenAndAreDarkenedWhereTheMapIsInverted) {
  const DisplayOptions inverted{.color_map = "gray-inverted"};
  expect_shown(0.0f, kTool, inverted, kTool);
  expect_shown(0.6f, kTool, inverted, {0.25, 0.4, 0.4});
  expect_shown(1.0f, kTool, inverted, {0.0, 0.0, 0.0});
  for (const float pixel : {0.0f, 0.3f, 1.0f}) {
    for (const PictureMode mode : {PictureMode::Max, PictureMode::Sum}) {
      const glm::dvec3 negative =
          shown_color(pixel, 1.0f - kTool, {.color_map = "gray-inverted", .mode = mode});
      expect_shown(pixel, kTool, {.mode = mode}, 1.0 - negative);
    }
  }
}

TEST(DisplayTools, BrighterThanWhiteAreWhite) {
  expect_shown(0.0f, {1.5f, 0.5f, -0.0f}, {}, {1.0, 0.5, 0.0});
}

TEST(DisplayTools, LeavePixelsWithoutThemAlone) {
  const Picture picture = with_tool({0.3f, 0.3f}, {0, 1}, kTool);
  const DisplayImage shown = display_picture(picture, {.color_map = "viridis"});
  const DisplayImage alone = display_picture(picture.volume, {}, "viridis");
  EXPECT_TRUE(std::equal(shown.pixels.begin(), shown.pixels.begin() + 3, alone.pixels.begin()));
  EXPECT_NE(shown.pixels, alone.pixels);
}

TEST(DisplayTools, OutOfSightChangeNothing) {
  const Picture picture = with_tool({0.3f, 0.6f}, {0, 0}, kTool);
  for (const std::string_view name : color_map_names()) {
    EXPECT_EQ(display_picture(picture, {.color_map = name}).pixels,
              display_picture(picture.volume, {}, name).pixels)
        << name;
  }
}

}  // namespace
}  // namespace nacre

#include "report/command_lines.h"

#include <gtest/gtest.h>

namespace nacre {
namespace {

using Lines = std::vector<std::string>;

const CommandTexts kTexts{.volume = "a.nii --window 0,28",
                          .camera = "--turntable 2",
                          .tools = "--tool needle.stl",
                          .cue = {0.8, 0.2, 0.0}};

TEST(CommandLines, OfTheExactWalkAreOne) {
  EXPECT_EQ(command_lines({.id = "max-exact", .part = "max"}, kTexts),
            (Lines{"nacre reference a.nii --window 0,28 --mode max --turntable 2 "
                   "-o exact-%03d.tif"}));
}

TEST(CommandLines, OfSamplesDrawTheVolumeTwiceAndCompare) {
  EXPECT_EQ(command_lines(
                {.id = "max-sampled-4", .part = "max", .samples = 4, .backend = "sampled"}, kTexts),
            (Lines{"nacre render a.nii --window 0,28 --method sampled --samples 4 --mode max "
                   "--turntable 2 -o sampled-%03d.tif",
                   "nacre reference a.nii --window 0,28 --mode max --turntable 2 -o exact-%03d.tif",
                   "nacre compare sampled-%03d.tif exact-%03d.tif"}));
}

TEST(CommandLines, CuesAndToolsAreThoseOfTheExactPicture) {
  const Subject subject{.cued = true, .with_tool = true};
  const Lines lines = command_lines(
      {.id = "cued", .part = "depth", .subject = subject, .samples = 2, .backend = "sampled"},
      kTexts);
  ASSERT_EQ(lines.size(), 3U);
  for (const std::size_t drawing : {0U, 1U}) {
    EXPECT_NE(lines[drawing].find(" --cue 0.8,0.2,0 --tool needle.stl "), std::string::npos)
        << lines[drawing];
  }
}

TEST(CommandLines, OfShellsBuildThemFirst) {
  EXPECT_EQ(command_lines(
                {.id = "max-24-cpu", .part = "max", .shells = ShellRecipe{{24}}, .backend = "cpu"},
                kTexts),
            (Lines{"nacre build a.nii --window 0,28 --levels 24 --placement uniform "
                   "--certificate none -o shells.glb",
                   "nacre render shells.glb --backend cpu --mode max --turntable 2 "
                   "-o shells-%03d.tif",
                   "nacre reference a.nii --window 0,28 --mode max --turntable 2 "
                   "-o exact-%03d.tif",
                   "nacre compare shells-%03d.tif exact-%03d.tif"}));
}

}  // namespace
}  // namespace nacre

// The command as a user has it: exit statuses, one-line errors, nothing left behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "io/picture_file.h"
#include "io/png_picture.h"
#include "tests/app/phantom_command.h"

namespace nacre {
namespace {

using nlohmann::json;
using testing::Command;
using testing::CommandResult;

TEST_F(Command, SaysItsVersionAndExplainsEveryVerb) {
  EXPECT_EQ(nacre("--version").output, "nacre " NACRE_VERSION "\n");
  EXPECT_EQ(nacre("-h").status, 0);
  for (const char* verb : {"phantom", "reference", "render", "compare", "info", "verify"}) {
    const CommandResult help = nacre(std::string(verb) + " -h");
    EXPECT_EQ(help.status, 0) << verb;
    EXPECT_NE(help.output.find("Example: nacre "), std::string::npos) << verb;
  }
}

TEST_F(Command, WrongUseIsStatusTwo) {
  expect_refusal("frobnicate", 2, "frobnicate");
  expect_refusal("reference", 2, "VOLUME");
  expect_refusal("reference ball.nii", 2, "-o");
  expect_refusal("reference ball.nii -o a.jpg", 2, ".png, .tif");
  expect_refusal("reference ball.nii -o a.png --window 5", 2, "LO,HI");
  expect_refusal("reference ball.nii -o a.png --window 5,5", 2, "LO < HI");
  expect_refusal("reference ball.nii -o a.png --window 5,nan", 2, "window");
  expect_refusal("reference ball.nii -o a.png --map 1:0,2", 2, "VALUE:EMISSION");
  expect_refusal("reference ball.nii -o a.png --size 0x5", 2, "--size");
  expect_refusal("reference ball.nii -o a.png --size 5", 2, "WxH");
  expect_refusal("reference ball.nii -o a.png --view front", 2, "anterior");
  expect_refusal("reference ball.nii -o a.png --zoom 0", 2, "zoom");
  expect_refusal("reference ball.nii -o a.png --azimuth x", 2, "azimuth");
  expect_refusal("reference ball.nii -o a.png --perspective 180", 2, "field of view");
  expect_refusal("reference ball.nii -o a.png --distance 100", 2, "perspective");
  expect_refusal("reference ball.nii -o a.png --slab 5,-5", 2, "NEAR < FAR");
  expect_refusal("reference ball.nii -o a.png --look-at 1,2", 2, "X,Y,Z");
  expect_refusal("reference ball.nii -o a.png --mode average", 2, "max, sum, count or iso");
  expect_refusal("reference ball.nii -o a.png --colormap jet", 2, "jet");
  expect_refusal("reference ball.nii -o a.png --turntable 5", 2, "%03d");
  expect_refusal("reference ball.nii -o t%03d.apng --turntable 5", 2, "one .apng holds all views");
  expect_refusal("reference ball.nii -o a.png --tool-blend mix", 2, "max or over");
  expect_refusal("reference ball.nii -o a.png --display 1", 2, "LO,HI");
  expect_refusal("reference ball.nii -o a.png --display 1,1 --mode sum", 2, "LO < HI");
  expect_refusal("reference ball.nii --turntable 2 --colormap jet", 2, "viridis");
  expect_refusal("reference ball.nii -o a.png --cue 1,2", 2, "A,B,BETA0");
  expect_refusal("reference ball.nii -o a.png --cue -2,1,0", 2, "depth cue");
  // No picture either, where the figures cannot be written.
  expect_refusal("reference ball.nii -o a.png --json no/such/folder.json", 2, "cannot be created");
  expect_refusal("reference ball.nii -o a.png --crop 0,99,0,1,0,1", 2, "crop");
  expect_refusal("reference ball.nii -o a.png --threads 0", 2, "threads");
  expect_refusal("reference ball.nii -o no/such/folder/a.png", 2, "cannot be created");
  expect_refusal("reference ball.nii -o a.png --frobnicate", 2, "frobnicate");
  expect_refusal("render ball.nii --method sampled --mode sum -o a.png", 2, "expected max");
  expect_refusal("render ball.nii --method sampled --samples 0 -o a.png", 2, "samples");
  expect_refusal("render ball.nii --method sampled --samples 17 -o a.png", 2, "samples");
  expect_refusal("render ball.nii --samples 2 -o a.png", 2, "--method sampled");
  expect_refusal("render ball.glb --method sampled -o a.png", 2, "volume");
  expect_refusal("phantom", 2, "NAME");
  expect_refusal("phantom unicorn -o a.nii", 2, "unicorn");
  expect_refusal("phantom spheres -o a.doc", 2, ".nrrd");
  expect_refusal("phantom spheres -o a.nii --size 5,5", 2, "X,Y,Z");
  EXPECT_EQ(nacre("").status, 2);
}

TEST_F(Command, BadInputIsStatusThree) {
  folder_.write("empty.nii", "");
  folder_.write("text.nii.gz", "this is no volume");
  folder_.write("short.raw", "123");
  for (const char* verb : {"reference", "render", "info"}) {
    const std::string output = std::string(verb) == "info" ? "" : " -o a.png";
    expect_refusal(std::string(verb) + " none.nii" + output, 3, "none.nii");
    expect_refusal(std::string(verb) + " empty.nii" + output, 3, "empty.nii");
    expect_refusal(std::string(verb) + " text.nii.gz" + output, 3, "text.nii.gz");
    expect_refusal(std::string(verb) + " short.raw --raw 2,2,2,u8" + output, 3, "short.raw");
  }
  expect_refusal("compare none.tif ball.png", 3, "none.tif");
}

TEST_F(Command, ReferenceWritesWhatItSays) {
  const CommandResult result =
      nacre("reference ball.nii --window 0,28 --size 40x30 -o a.tif --json -");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json figures = json::parse(result.output);
  EXPECT_EQ(figures["backend"], "exact");
  EXPECT_EQ(figures["seconds"]["frames"].size(), 1u);
  EXPECT_EQ(figures["window"], json({0.0, 28.0}));
  const PictureFile picture = read_picture(folder_.path() / "a.tif");
  EXPECT_EQ(picture.image.width, 40);
  EXPECT_EQ(picture.image.height, 30);
  EXPECT_EQ(picture.mode, PictureMode::Max);
  EXPECT_NEAR(figures["picture"]["greatest"].get<double>(),
              *std::max_element(picture.image.pixels.begin(), picture.image.pixels.end()), 1e-6);
}

TEST_F(Command, RenderExactIsTheReferenceBitForBit) {
  ASSERT_EQ(nacre("reference ball.nii --azimuth 20 --size 32x32 -o a.tif").status, 0);
  ASSERT_EQ(
      nacre("render ball.nii --method exact --azimuth 20 --size 32x32 --threads 1 -o b.tif").status,
      0);
  EXPECT_EQ(testing::read_bytes(folder_.path() / "a.tif"),
            testing::read_bytes(folder_.path() / "b.tif"));
}

TEST_F(Command, RenderSampledIsNearTheReferenceAndNotAboveIt) {
  const std::string view = "ball.nii --window 0,28 --azimuth 20 --elevation 10 --size 64x64";
  ASSERT_EQ(nacre("reference " + view + " -o a.tif").status, 0);
  const CommandResult result =
      nacre("render " + view + " --method sampled --samples 4 -o b.tif --json -");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json figures = json::parse(result.output);
  EXPECT_EQ(figures["backend"], "sampled");
  EXPECT_NE(figures["renderer"].get<std::string>().find("4 a voxel"), std::string::npos);
  const Image exact = read_picture(folder_.path() / "a.tif").image;
  const Image sampled = read_picture(folder_.path() / "b.tif").image;
  double most = 0.0;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    EXPECT_LE(sampled.pixels[i], exact.pixels[i] + 1e-4F);
    most = std::max(most, static_cast<double>(exact.pixels[i] - sampled.pixels[i]));
  }
  EXPECT_GT(most, 0.0);
  EXPECT_LT(most, 0.05);
  const CommandResult wide = nacre(
      "render ball.nii --window 0,28 --size 16x16 --azimuth 45 --perspective 150 --distance 2 "
      "--method sampled -o d.tif --json -");
  EXPECT_EQ(json::parse(wide.output)["backend"], "exact");
  EXPECT_NE(wide.errors.find("the exact picture is drawn"), std::string::npos);
  ASSERT_EQ(nacre("render " + view + " --method sampled --samples 4 --threads 1 -o c.tif").status,
            0);
  EXPECT_EQ(testing::read_bytes(folder_.path() / "b.tif"),
            testing::read_bytes(folder_.path() / "c.tif"));
}

TEST_F(Command, TurntableNumbersItsPictures) {
  ASSERT_EQ(nacre("reference ball.nii --size 8x8 --turntable 3 -o t%02d.png").status, 0);
  for (const char* name : {"t00.png", "t01.png", "t02.png"}) {
    EXPECT_EQ(read_png(folder_.path() / name).width, 8) << name;
  }
  const CommandResult timing = nacre("reference ball.nii --size 8x8 --turntable 5 --json -");
  EXPECT_EQ(json::parse(timing.output)["seconds"]["frames"].size(), 5u);
}

TEST_F(Command, TurntableMayBeOneAnimatedPng) {
  ASSERT_EQ(nacre("reference ball.nii --size 8x8 --mode sum --turntable 3 -o t.apng").status, 0);
  EXPECT_EQ(read_png(folder_.path() / "t.apng").width, 8);
  EXPECT_NE(testing::read_bytes(folder_.path() / "t.apng").find("fdAT"), std::string::npos);
}

TEST_F(Command, TurntableShowsASumWithOneWindow) {
  const CommandResult all =
      nacre("reference ball.nii --size 8x8 --mode sum --turntable 3 -o t%d.png --json -");
  double largest = 0.0;
  for (const char* azimuth : {"0", "120", "240"}) {
    const CommandResult one = nacre(std::string("reference ball.nii --size 8x8 --mode sum -o a.tif "
                                                "--json - --azimuth ") +
                                    azimuth);
    largest = std::max(largest, json::parse(one.output)["picture"]["greatest"].get<double>());
  }
  EXPECT_NEAR(json::parse(all.output)["display"][1].get<double>(), largest, 1e-6 * largest);
}

// Through the middle of a ball a ray crosses its one shell twice, and meets it face on.
TEST_F(Command, TheExactWalkShowsShellsToo) {
  const std::string exact = "reference ball.nii --window 0,28 --levels 0.5 --size 33x33 ";
  const auto middle = [&](const std::string& flags) {
    EXPECT_EQ(nacre(exact + flags + " -o a.tif").status, 0) << flags;
    return read_picture(folder_.path() / "a.tif").image.at(16, 16);
  };
  EXPECT_FLOAT_EQ(middle("--mode count"), 2.0f);
  EXPECT_NEAR(middle("--mode iso"), 1.0f, 0.05f);
  EXPECT_FLOAT_EQ(middle("--mode max --ideal"), 1.0f);
  expect_refusal("reference ball.nii -o b.png --mode iso --levels 0", 2, "--levels");
}

TEST_F(Command, EveryColourMapIsListedAndWorks) {
  const std::string help = nacre("render -h").output;
  for (const char* map : {"gray", "gray-inverted", "hot", "hot-iron", "bone", "angio", "viridis",
                          "inferno", "magma", "plasma", "cividis"}) {
    EXPECT_NE(help.find(map), std::string::npos) << map;
    ASSERT_EQ(nacre(std::string("reference ball.nii --size 8x8 -o a.png --colormap ") + map).status,
              0);
    EXPECT_EQ(read_png(folder_.path() / "a.png").channels,
              std::string(map).rfind("gray", 0) == 0 ? 1 : 3);
  }
}

TEST_F(Command, CompareMeasuresAndJudges) {
  ASSERT_EQ(nacre("reference ball.nii --window 0,28 --size 32x32 -o a.tif").status, 0);
  ASSERT_EQ(nacre("reference ball.nii --window 0,30 --size 32x32 -o b.tif").status, 0);
  const CommandResult same = nacre("compare a.tif a.tif --min-psnr 100 --max-rmse 0 --json -");
  EXPECT_EQ(same.status, 0);
  EXPECT_TRUE(json::parse(same.output)["all"]["psnr_db"].is_null());
  const CommandResult other = nacre("compare b.tif a.tif -o d.png --json f.json");
  EXPECT_EQ(other.status, 0);
  EXPECT_EQ(read_png(folder_.path() / "d.png").channels, 3);
  const json figures = json::parse(testing::read_bytes(folder_.path() / "f.json"));
  EXPECT_GT(figures["all"]["rmse"].get<double>(), 0.0);
  EXPECT_LT(figures["all"]["bias"].get<double>(), 0.0);
  EXPECT_EQ(nacre("compare b.tif a.tif --min-psnr 90").status, 1);
  EXPECT_EQ(nacre("compare b.tif a.tif --max-rmse 1e-9").status, 1);
}

TEST_F(Command, CompareRefusesOtherSizes) {
  ASSERT_EQ(nacre("reference ball.nii --size 16x16 -o a.tif").status, 0);
  ASSERT_EQ(nacre("reference ball.nii --size 16x17 -o b.tif").status, 0);
  expect_refusal("compare a.tif b.tif -o d.png", 2, "16 x 17");
}

TEST_F(Command, InfoTellsShapeUnitsAndOrientation) {
  const CommandResult result = nacre("info ball.nii --json -");
  ASSERT_EQ(result.status, 0);
  const json figures = json::parse(result.output);
  EXPECT_EQ(figures["kind"], "volume");
  EXPECT_EQ(figures["volume"]["dims"], json({20, 18, 16}));
  EXPECT_EQ(figures["volume"]["type"], "f32");
  EXPECT_EQ(figures["orientation"], "LPS");
  EXPECT_EQ(figures["frame"], "LPS, mm");
}

TEST_F(Command, QuietSaysNothingAndAPipeSeesNoProgress) {
  const CommandResult quiet = nacre("reference ball.nii -q -o a.png");
  EXPECT_EQ(quiet.output, "");
  EXPECT_EQ(quiet.errors, "");
  const CommandResult loud = nacre("reference ball.nii --size 600x600 -o a.png");
  EXPECT_EQ(loud.errors, "");
  const CommandResult shown = nacre("reference ball.nii --progress always -o a.png");
  EXPECT_NE(shown.errors.find("rays"), std::string::npos);
}

TEST_F(Command, VerifyNeedsTheShellTools) {
  if (NACRE_HAS_SHELLS) GTEST_SKIP() << "built with the shell tools";
  expect_refusal("verify a.glb", 4, "shell tools");
}

TEST_F(Command, EveryFormatGivesTheSamePicture) {
  if (!NACRE_HAS_ITK) GTEST_SKIP() << "built without ITK: NIfTI is the only format";
  ASSERT_EQ(nacre("reference ball.nii --size 16x16 -o nii.tif").status, 0);
  for (const std::string format : {"nrrd", "nhdr", "mha", "mhd", "nii.gz"}) {
    ASSERT_EQ(nacre("phantom spheres --size 20,18,16 -o b." + format).status, 0) << format;
    ASSERT_EQ(nacre("reference b." + format + " --size 16x16 -o b.tif").status, 0) << format;
    EXPECT_EQ(testing::read_bytes(folder_.path() / "b.tif"),
              testing::read_bytes(folder_.path() / "nii.tif"))
        << format;
  }
}

}  // namespace
}  // namespace nacre

// Flags of the scene: depth cues and tools. Through the functions, and through the command.
#include "app/scene_flags.h"

#include <gtest/gtest.h>

#include <set>

#include "io/picture_file.h"
#include "io/png_picture.h"
#include "tests/support/expect_error.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

namespace nacre {
namespace {

using testing::expect_error;
using testing::ScratchFolder;

constexpr const char* kTetrahedron =
    "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

DepthCue cue(const std::string& text) {
  SceneFlags flags;
  flags.cue = text;
  return depth_cue(flags);
}

TEST(CueFlag, IsThreeNumbers) {
  EXPECT_TRUE(is_flat(cue("")));
  EXPECT_EQ(beta(cue(""), 0.3), 1.0);
  EXPECT_DOUBLE_EQ(beta(cue("0.8,0.1,0.1"), 0.5), 0.6);
  EXPECT_DOUBLE_EQ(beta(cue("-0.5,1,0"), 1.0), 0.5);
  for (const char* bad :
       {"1", "1,2", "1,2,3,4", "a,b,c", "1,,2", "nan,0,0", "-2,1,0", "1,-1,0.5"}) {
    EXPECT_THROW(cue(bad), Error) << bad;
  }
  expect_error(ErrorCode::BadArgument, "A,B,BETA0", [] { cue("1,2"); });
  expect_error(ErrorCode::BadArgument, "-1", [] { cue("-2,1,0"); });
}

class ToolFlags : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!NACRE_HAS_SHELLS) GTEST_SKIP() << "built without the tool reader";
    folder_.write("a.off", kTetrahedron);
    folder_.write("pose.txt", "0 -1 0 10\n1 0 0 20\n0 0 1 30\n0 0 0 1\n");
  }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  Tool read(const std::string& text) const {
    SceneFlags flags;
    flags.tools = {path(text)};
    return read_tools(flags).at(0);
  }

  ScratchFolder folder_;
};

TEST_F(ToolFlags, PoseIsAppliedAfterScale) {
  const Tool tool = read("a.off,scale=1000,pose=" + path("pose.txt") + ",color=#ff8000");
  EXPECT_EQ(tool.world_from_tool * glm::dvec4(0.001, 0.002, 0.003, 1), glm::dvec4(8, 21, 33, 1));
  EXPECT_EQ(tool.color, glm::vec3(1.0F, 128.0F / 255.0F, 0.0F));
  EXPECT_EQ(tool.name, "a.off");
  EXPECT_EQ(tool.mesh.triangles.size(), 4u);
}

TEST_F(ToolFlags, NamesMayHoldCommas) {
  folder_.write("left, small.off", kTetrahedron);
  folder_.write("p,q.txt", "1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1");
  const Tool tool = read("left, small.off,pose=" + path("p,q.txt") + ",scale=2");
  EXPECT_EQ(tool.name, "left, small.off");
  EXPECT_EQ(tool.world_from_tool * glm::dvec4(1, 1, 1, 1), glm::dvec4(7, 2, 2, 1));
}

TEST_F(ToolFlags, ToolsWithoutAColourAreToldApart) {
  SceneFlags flags;
  flags.tools.assign(7, path("a.off"));
  std::set<float> sums;
  for (const Tool& tool : read_tools(flags)) {
    sums.insert(tool.color.r + 3.0F * tool.color.g + 7.0F * tool.color.b);
  }
  EXPECT_EQ(sums.size(), 7u);
}

TEST_F(ToolFlags, RefusesOptionsThatAreWrong) {
  for (const char* bad : {",color=red", ",color=#12345", ",color=#1234567", ",color=#12345g",
                          ",color=#+12345", ",color=", ",scale=0", ",scale=-1", ",scale=x",
                          ",scale=nan", ",scale=1e300", ",colour=#112233", ",scale=1,scale=2"}) {
    expect_error(ErrorCode::BadArgument, "--tool", [&] { read(std::string("a.off") + bad); });
  }
  SceneFlags flags;
  flags.tools = {""};
  expect_error(ErrorCode::BadArgument, "FILE[,pose=FILE]", [&] { read_tools(flags); });
}

TEST_F(ToolFlags, RefusesFilesThatAreWrong) {
  expect_error(ErrorCode::BadFile, "No such file", [&] { read("none.stl"); });
  expect_error(ErrorCode::BadFile, "No such file", [&] { read("a.off,pose=none.txt"); });
  const auto singular = folder_.write("flat.txt", "1 0 0 0 0 0 0 0 0 0 1 0 0 0 0 1");
  expect_error(ErrorCode::BadFile, "a rigid pose",
               [&] { read("a.off,pose=" + singular.string()); });
  folder_.write("far.off", "OFF\n3 1 3\n0 0 0\n1e30 0 0\n0 1 0\n3 0 1 2\n");
  expect_error(ErrorCode::BadFile, "a vertex at 1e+30 mm", [&] { read("far.off"); });
}

/// Runs the command.
class SceneCommand : public ToolFlags {
 protected:
  testing::CommandResult nacre(const std::string& arguments) const {
    return testing::run_command(NACRE_BINARY, arguments, folder_.path());
  }
};

TEST_F(SceneCommand, InfoDescribesATool) {
  const auto result = nacre("info a.off --json f.json");
  ASSERT_EQ(result.status, 0) << result.errors;
  EXPECT_NE(result.output.find("4 triangles, 4 vertices"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("file units"), std::string::npos);
  const std::string figures = testing::read_bytes(folder_.path() / "f.json");
  EXPECT_NE(figures.find("\"kind\": \"tool\""), std::string::npos) << figures;
  EXPECT_NE(figures.find("\"winding\": \"outward\""), std::string::npos) << figures;
}

TEST_F(SceneCommand, InfoRefusesADamagedToolWithStatusThree) {
  folder_.write("b.stl", "solid short\nfacet normal 0 0 1\n");
  const auto result = nacre("info b.stl");
  EXPECT_EQ(result.status, 3);
  EXPECT_NE(result.errors.find("b.stl: found"), std::string::npos) << result.errors;
}

/// A command with a volume and a tool, seen from the front.
class PictureCommand : public SceneCommand {
 protected:
  void SetUp() override {
    SceneCommand::SetUp();
    if (IsSkipped()) return;
    ASSERT_EQ(nacre("phantom spheres --size 12,12,12 -o ball.nii").status, 0);
    // A square before the volume's right half (LPS: x < 0), and its name holds no comma.
    folder_.write("square.off",
                  "OFF\n4 1 4\n-50 -50 -50\n0 -50 -50\n0 -50 50\n-50 -50 50\n4 0 1 2 3\n");
  }

  static constexpr const char* kView = " --window 0,28 --size 32x32 --look-at 0,0,0 --zoom 0.8 ";
};

TEST_F(PictureCommand, ToolsCutOffTheVolumeAndColourThePng) {
  for (const char* mode : {"max", "sum"}) {
    const std::string exact = std::string("reference ball.nii --mode ") + mode + kView;
    ASSERT_EQ(nacre(exact + "-o bare.tif").status, 0);
    ASSERT_EQ(nacre(exact + "-o cut.tif --tool square.off").status, 0);
    ASSERT_EQ(nacre(exact + "-o cut.png --tool square.off,color=#0000ff").status, 0);
    const Image bare = read_picture(folder_.path() / "bare.tif").image;
    const Image cut = read_picture(folder_.path() / "cut.tif").image;
    const DisplayImage shown = read_png(folder_.path() / "cut.png");
    ASSERT_EQ(shown.channels, 3);
    int hidden = 0;
    for (std::size_t i = 0; i < bare.pixels.size(); ++i) {
      const bool tool = shown.pixels[3 * i + 2] > shown.pixels[3 * i];  // bluer than red
      EXPECT_EQ(cut.pixels[i], tool ? 0.0f : bare.pixels[i]) << mode << ", pixel " << i;
      if (tool && bare.pixels[i] > 0.0f) ++hidden;
    }
    EXPECT_GT(hidden, 10) << mode;
  }
}

TEST_F(PictureCommand, CueDarkensWhatIsFar) {
  const std::string exact = std::string("reference ball.nii") + kView;
  ASSERT_EQ(nacre(exact + "-o bare.tif").status, 0);
  ASSERT_EQ(nacre(exact + "-o flat.tif --cue 0,0.4,0.1").status, 0);
  ASSERT_EQ(nacre(exact + "-o none.tif --cue 0,1,0").status, 0);
  EXPECT_EQ(testing::read_bytes(folder_.path() / "bare.tif"),
            testing::read_bytes(folder_.path() / "none.tif"));
  const Image bare = read_picture(folder_.path() / "bare.tif").image;
  const Image flat = read_picture(folder_.path() / "flat.tif").image;
  for (std::size_t i = 0; i < bare.pixels.size(); ++i) {
    EXPECT_NEAR(flat.pixels[i], 0.5f * bare.pixels[i], 1e-6f);
  }
}

TEST(SceneFlags, WithoutTheToolReaderAreStatusFour) {
  if (NACRE_HAS_SHELLS) GTEST_SKIP() << "built with the tool reader";
  const ScratchFolder folder;
  folder.write("a.off", kTetrahedron);
  const auto result = testing::run_command(NACRE_BINARY, "info a.off", folder.path());
  EXPECT_EQ(result.status, 4);
  EXPECT_NE(result.errors.find("OpenMesh"), std::string::npos) << result.errors;
}

}  // namespace
}  // namespace nacre

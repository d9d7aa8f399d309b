// The command on shell sets: listed, drawn, compared and checked.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/quantization_grid.h"
#include "core/shell_set.h"
#include "io/shell_reader.h"
#include "io/shell_writer.h"
#include "tests/app/shell_command.h"

namespace nacre {
namespace {

using nlohmann::json;
using testing::CommandResult;
using testing::ShellCommand;

TEST_F(ShellCommand, InfoListsTheShells) {
  const CommandResult result = nacre("info ball.glb --json -");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json figures = json::parse(result.output);
  EXPECT_EQ(figures["kind"], "shell set");
  EXPECT_EQ(figures["levels"].size(), 7u);
  EXPECT_EQ(figures["window"], json({0.0, 28.0}));
}

// Seven levels: each pixel is within half a layer of the exact maximum, but at silhouettes.

TEST_F(ShellCommand, RenderShowsTheExactPictureToHalfALayer) {
  require_backend();
  ASSERT_EQ(nacre("reference ball.nii --window 0,28 --size 64x64 --azimuth 30 -o exact.tif").status,
            0);
  ASSERT_EQ(nacre("render ball.glb --size 64x64 --azimuth 30 -o shells.tif").status, 0);
  ASSERT_EQ(nacre("render ball.nii --window 0,28 --levels 7 --method shells --size 64x64 "
                  "--azimuth 30 -o memory.tif")
                .status,
            0);
  EXPECT_EQ(testing::read_bytes(folder_.path() / "shells.tif"),
            testing::read_bytes(folder_.path() / "memory.tif"));
  EXPECT_EQ(nacre("compare shells.tif exact.tif --max-rmse 0.06").status, 0);
}

TEST_F(ShellCommand, TheProcessorDrawsAsOpenGlDoes) {
  require_backend();
  for (const std::string how :
       {"", " --slab=-3,2", " --cue=-0.5,1,0 --slab=-3,2", " --mode sum", " --mode count",
        " --mode sum --cue=-0.5,1,0 --slab=-3,2", " --mode count --slab=-3,2"}) {
    const std::string render = "render ball.glb --size 64x64 --azimuth 30" + how + " --backend ";
    ASSERT_EQ(nacre(render + "cpu -o ours.tif").status, 0);
    const bool osmesa = nacre(render + "osmesa -o theirs.tif").status == 0;
    ASSERT_TRUE(osmesa || nacre(render + "egl -o theirs.tif").status == 0);
    EXPECT_EQ(nacre("compare ours.tif theirs.tif --max-rmse 0.002").status, 0);
  }
}

TEST_F(ShellCommand, TheProcessorSaysWhatItDoesNotDraw) {
  expect_refusal("render ball.glb --backend cpu --mode iso -o a.tif", 4,
                 "maximum projections, sums and counts");
  expect_refusal("render ball.glb --backend cpu --mode sum --target 16f -o a.tif", 4,
                 "found target 16f, expected 32f");
  expect_refusal("render ball.glb --backend vulkan -o a.tif", 2,
                 "expected auto, egl, osmesa or cpu");
}

TEST_F(ShellCommand, ErrorsAreSplitIntoCausesThatAddUp) {
  require_backend();
  const std::string explain = "compare --explain-error ball.glb --volume ball.nii --size 64x64 ";
  const CommandResult drawn = nacre(explain + "--azimuth 30 --json -");
  ASSERT_EQ(drawn.status, 0) << drawn.errors;
  const json figures = json::parse(drawn.output);
  const json& split = figures["error_split"];
  double shares = 0.0;
  for (const json& cause : split["causes"]) shares += cause["share"].get<double>();
  EXPECT_NEAR(shares, 1.0, 1e-12);
  ASSERT_EQ(split["causes"].size(), 5u);
  EXPECT_EQ(split["causes"][0]["cause"], "levels");
  EXPECT_EQ(split["causes"][3]["rmse"], 0.0) << "nothing was simplified";
  EXPECT_NEAR(split["total"]["rmse"].get<double>(), figures["all"]["rmse"].get<double>(), 1e-12);
  EXPECT_NE(drawn.errors.find("dominates"), std::string::npos);

  // A picture that was drawn before has the same causes.
  ASSERT_EQ(nacre("render ball.glb --size 64x64 --azimuth 30 --layers flat -o shells.tif").status,
            0);
  const CommandResult given = nacre(explain + "--azimuth 30 --json - shells.tif");
  ASSERT_EQ(given.status, 0) << given.errors;
  EXPECT_EQ(json::parse(given.output)["error_split"], split);
}

TEST_F(ShellCommand, AnErrorIsNotExplainedByAnotherVolumeOrPicture) {
  ASSERT_EQ(nacre("phantom torus --size 20,18,16 -o other.nii").status, 0);
  const std::string explain = "compare --explain-error ball.glb ";
  expect_refusal(explain + "--volume other.nii", 2, "the shell set was made from");
  expect_refusal(explain, 2, "--volume");
  expect_refusal(explain + "--volume ball.nii a.tif b.tif", 2, "b.tif");
  expect_refusal(explain + "--volume ball.nii --turntable 4", 2, "--turntable");
  expect_refusal("compare a.tif b.tif --azimuth 30", 2, "--explain-error");
  ASSERT_EQ(nacre("reference ball.nii --size 16x16 -o small.tif").status, 0);
  expect_refusal(explain + "--volume ball.nii small.tif", 2, "16 x 16");
}

TEST_F(ShellCommand, HiddenShellsAreLeftOutAndNotDrawn) {
  require_backend();
  const CommandResult all = nacre("render ball.glb --size 32x32 -o a.tif --json - --explain");
  const CommandResult some = nacre("render ball.glb --size 32x32 --only 2,3 -o b.tif --json -");
  ASSERT_EQ(some.status, 0) << some.errors;
  const json figures = json::parse(some.output);
  EXPECT_LT(figures["triangles_drawn"].get<int>(),
            json::parse(all.output)["triangles_drawn"].get<int>());
  EXPECT_NE(figures["left_out"].dump().find("hidden"), std::string::npos);
  EXPECT_NE(all.errors.find("back faces"), std::string::npos);
}

TEST_F(ShellCommand, WrongUseIsStatusTwo) {
  expect_refusal("build ball.nii -o a.stl", 2, ".glb");
  expect_refusal("build ball.nii --levels 0 -o a.glb", 2, "--levels");
  expect_refusal("build ball.nii --levels 0.5,0.2 -o a.glb", 2, "ascending");
  expect_refusal("build ball.nii --levels 1.5,2 -o a.glb", 2, "level");
  expect_refusal("build ball.nii --placement best -o a.glb", 2, "placement");
  expect_refusal("render ball.glb --method exact -o a.png", 2, "volume");
  expect_refusal("render ball.glb --backend metal -o a.png", 2, "metal");
  expect_refusal("render ball.glb --depth-buffer 8 -o a.png", 2, "16, 24 or 32f");
  expect_refusal("render ball.glb --hide 9 -o a.png", 2, "shell 9");
  expect_refusal("render -o a.png", 2, "INPUT");
}

TEST_F(ShellCommand, DamagedSetsAreStatusThree) {
  folder_.write("empty.glb", "");
  folder_.write("text.glb", "glTF is what this is not");
  std::string bytes = testing::read_bytes(folder_.path() / "ball.glb");
  folder_.write("short.glb", bytes.substr(0, bytes.size() / 2));
  bytes[bytes.size() - 20] ^= 1;
  folder_.write("flipped.glb", bytes);
  for (const char* verb : {"render", "info"}) {
    const std::string output = std::string(verb) == "info" ? "" : " -o a.png";
    for (const char* name : {"none.glb", "empty.glb", "text.glb", "short.glb"}) {
      expect_refusal(std::string(verb) + " " + name + output, 3, name);
    }
  }
  expect_refusal("render flipped.glb -o a.png", 3, "damaged");
}

TEST_F(ShellCommand, VerifyAgreesWithWhatBuildMade) {
  const CommandResult result = nacre("verify ball.glb --volume ball.nii --json -");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json figures = json::parse(result.output);
  EXPECT_TRUE(figures["kept"].get<bool>());
  EXPECT_EQ(figures["kind"], "shell set");
  ASSERT_EQ(figures["shells"].size(), 7u);
  for (const json& shell : figures["shells"]) {
    EXPECT_EQ(shell["open_edges"], 0);
    EXPECT_EQ(shell["off_grid"], 0);
    EXPECT_EQ(shell["degenerate"], 0);
    EXPECT_LT(shell["volume"]["max_error"].get<double>(), 0.2);
  }
  EXPECT_NE(nacre("verify ball.glb").output.find("all promises kept"), std::string::npos);
}

TEST_F(ShellCommand, VerifyFindsBrokenPromises) {
  ASSERT_EQ(nacre("phantom spheres --size 20,18,16 --noise 5 -o other.nii").status, 0);
  const CommandResult other = nacre("verify ball.glb --volume other.nii");
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.errors.find("checksum"), std::string::npos) << other.errors;
  std::string bytes = testing::read_bytes(folder_.path() / "ball.glb");
  bytes[bytes.size() - 20] ^= 1;
  folder_.write("flipped.glb", bytes);
  const CommandResult flipped = nacre("verify flipped.glb --json -");
  EXPECT_EQ(flipped.status, 1);
  EXPECT_NE(flipped.errors.find("damaged"), std::string::npos) << flipped.errors;
  EXPECT_FALSE(json::parse(flipped.output)["kept"].get<bool>());
  folder_.write("text.glb", "glTF is what this is not");
  expect_refusal("verify text.glb", 3, "text.glb");
  expect_refusal("verify none.glb", 3, "none.glb");
  expect_refusal("verify ball.glb --volume none.nii", 3, "none.nii");
}

// By other verbs, from the file: the same views, drawn and compared.

TEST_F(ShellCommand, ACertificateIsWhatReferenceAndCompareMeasure) {
  require_backend();
  ASSERT_EQ(nacre("build ball.nii --window 0,28 --levels 7 --certificate 96x96 -o c.glb").status,
            0);
  const json info = json::parse(nacre("info c.glb --json -").output);
  const json& certificate = info["certificate"];
  EXPECT_EQ(certificate["size"], json({96, 96}));
  ASSERT_EQ(certificate["views"].size(), 7u);
  for (const std::size_t i : {std::size_t{2}, std::size_t{5}}) {
    const json& view = certificate["views"][i];
    for (const std::string measured : {"max", "max_fine", "sum"}) {
      const std::string mode = measured == "sum" ? "sum" : "max";
      const std::string picture = " --mode " + mode + " --size 96x96 --view " +
                                  view["view"].get<std::string>() + " --azimuth " +
                                  view["azimuth_deg"].dump() + " --elevation " +
                                  view["elevation_deg"].dump();
      ASSERT_EQ(nacre("reference ball.nii --window 0,28 -o exact.tif" + picture).status, 0);
      const std::string layers = measured == "max" ? " --layers flat" : "";
      ASSERT_EQ(nacre("render c.glb -o shells.tif" + layers + picture).status, 0);
      const json compared = json::parse(nacre("compare shells.tif exact.tif --json -").output);
      EXPECT_NEAR(view[measured]["psnr_db"].get<double>(), compared["all"]["psnr_db"].get<double>(),
                  0.1)
          << measured << " " << i;
      EXPECT_NEAR(view[measured]["psnr_lit_db"].get<double>(),
                  compared["lit"]["psnr_db"].get<double>(), 0.1);
      if (measured == "max_fine") continue;
      EXPECT_NEAR(view[measured]["peak"].get<double>(), compared["peak"].get<double>(),
                  1e-4 * view[measured]["peak"].get<double>());
    }
  }
  EXPECT_LT(certificate["max_fine"]["rmse"], certificate["max"]["rmse"]);
  EXPECT_NE(nacre("info c.glb").output.find("certified    max, fine layers: "), std::string::npos);
}

TEST_F(ShellCommand, LayersAreFineSmoothOrFlat) {
  ASSERT_EQ(nacre("reference ball.nii --window 0,28 -o exact.tif").status, 0);
  const auto rmse = [&](const std::string& flags, const std::string& layers) {
    const CommandResult drawn = nacre("render ball.glb --backend cpu -o a.tif --json - " + flags);
    EXPECT_EQ(drawn.status, 0) << drawn.errors;
    EXPECT_EQ(json::parse(drawn.output)["layers"], layers);
    return json::parse(nacre("compare a.tif exact.tif --json -").output)["all"]["rmse"]
        .get<double>();
  };
  const double fine = rmse("", "fine");
  const double smooth = rmse("--layers smooth", "smooth");
  EXPECT_EQ(fine, rmse("--layers fine", "fine"));
  EXPECT_LE(fine, smooth);
  EXPECT_LT(smooth, 0.8 * rmse("--layers flat", "flat"));
  const CommandResult said = nacre("render ball.glb --backend cpu --explain -o a.tif");
  EXPECT_NE(said.output.find("fine     8 layers"), std::string::npos) << said.output;
  EXPECT_NE(said.output.find("from 3 x 3 rays a pixel"), std::string::npos) << said.output;
  const CommandResult cued =
      nacre("render ball.glb --backend cpu --cue 0.5,0.5,0 --explain -o a.tif");
  EXPECT_NE(cued.output.find("left out smooth layers: under a cue"), std::string::npos);
  expect_refusal("render ball.glb --layers round -o a.tif", 2,
                 "--layers: found 'round', expected fine, smooth or flat");
}

/// What `verify` finds in ball.glb once its surfaces are damaged, written anew by the library.
class DamagedShells : public ShellCommand {
 protected:
  template <class Damage>
  CommandResult verify(Damage&& damage) const {
    ShellSet set = read_shell_set(folder_.path() / "ball.glb");
    damage(set);
    write_shell_set(folder_.path() / "damaged.glb", set);
    return nacre("verify damaged.glb --json -");
  }

  template <class Damage>
  void expect_broken(Damage&& damage, const std::string& promise) const {
    const CommandResult result =
        verify([&](ShellSet& set) { damage(set.shells[2].surface.triangles); });
    EXPECT_EQ(result.status, 1) << promise;
    EXPECT_NE(result.errors.find("shell 3: found " + promise), std::string::npos) << result.errors;
  }

  template <class Damage>
  void expect_warning(Damage&& damage, const std::string& warning) const {
    const CommandResult result = verify(damage);
    EXPECT_EQ(result.status, 0) << result.errors;  // true of real scans: no promise
    EXPECT_NE(result.errors.find(warning), std::string::npos) << result.errors;
  }
};

TEST_F(DamagedShells, BreakTheirPromises) {
  using Triangles = std::vector<glm::uvec3>;
  expect_broken([](Triangles& triangles) { triangles.pop_back(); }, "3 open edges");
  // Compressing cuts what is no oriented surface apart: the turned triangle, and the hole it left.
  expect_broken([](Triangles& triangles) { std::swap(triangles[0].x, triangles[0].y); },
                "6 open edges");
}

TEST_F(DamagedShells, AreWarnedOfWhereNeighboursMeet) {
  expect_warning([](ShellSet& set) { set.shells[3].surface = set.shells[2].surface; },
                 "1 pairs of neighbouring shells come nearer than the grid's step");
  expect_warning(
      [](ShellSet& set) {
        const double step = step_mm(*set.grid);
        for (glm::vec3& p : set.shells[3].surface.positions) {
          p.x += static_cast<float>(std::round(6.0 / step) * step);
        }
      },
      "neighbouring shells cross: ");
}

}  // namespace
}  // namespace nacre

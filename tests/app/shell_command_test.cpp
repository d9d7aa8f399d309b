// The command on shell sets: built, drawn, checked, within budgets, with their statements kept.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/quantization_grid.h"
#include "core/shell_set.h"
#include "io/shell_reader.h"
#include "io/shell_writer.h"
#include "tests/app/phantom_command.h"

namespace nacre {
namespace {

using nlohmann::json;
using testing::Command;
using testing::CommandResult;

/// For what needs the shell tools and a GL context.
class ShellCommand : public Command {
 protected:
  void SetUp() override {
    if (!NACRE_HAS_SHELLS) GTEST_SKIP() << "built without the shell tools";
    Command::SetUp();
    ASSERT_EQ(
        nacre("build ball.nii --window 0,28 --levels 7 --certificate none -o ball.glb").status, 0);
  }

  void require_backend() const {
    if (nacre("render --list-backends").output.find("software") == std::string::npos &&
        nacre("render --list-backends").output.find("hardware") == std::string::npos) {
      GTEST_SKIP() << "no OpenGL context opens on this machine";
    }
  }
};

TEST_F(ShellCommand, BuildRefusesWhatIsNoTolerance) {
  const std::string build = "build ball.nii --window 0,28 -o b.glb ";
  expect_refusal(build + "--tolerance nan", 2, "found nan, expected an emission");
  expect_refusal(build + "--tolerance 2", 2, "found 2, expected an emission");
  expect_refusal(build + "--tolerance-mm nan", 2, "found nan, expected millimetres");
  expect_refusal(build + "--tolerance-mm -1", 2, "found -1, expected millimetres");
  expect_refusal(build + "--level-values 3,nan", 2, "found nan, expected finite values");
}

TEST_F(ShellCommand, BuildTellsItsFigures) {
  const CommandResult result = nacre(
      "build ball.nii --window 0,28 --levels 0.25,0.5,0.75 --certificate none -o b.glb --json -");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json figures = json::parse(result.output);
  EXPECT_EQ(figures["volume"]["dims"], json({20, 18, 16}));
  ASSERT_EQ(figures["levels"].size(), 3u);
  EXPECT_DOUBLE_EQ(figures["levels"][1]["emission"].get<double>(), 0.5);
  EXPECT_DOUBLE_EQ(figures["levels"][1]["value"].get<double>(), 14.0);
  EXPECT_GT(figures["triangles"].get<int>(), 100);
  EXPECT_GE(figures["extracted_triangles"].get<int>(), figures["triangles"].get<int>());
  EXPECT_EQ(figures["bytes"].get<std::size_t>(),
            std::filesystem::file_size(folder_.path() / "b.glb"));
  for (const char* stage :
       {"read", "emission", "extract", "simplify", "encode", "write", "total"}) {
    EXPECT_GE(figures["seconds"][stage].get<double>(), 0.0) << stage;
  }
}

TEST_F(ShellCommand, BuildGivesTheSameBytesForAnyNumberOfThreads) {
  for (const char* extra : {"", " --tolerance 0.02"}) {
    const std::string build = std::string("build ball.nii --levels 5 --certificate 20x20") + extra;
    ASSERT_EQ(nacre(build + " --threads 1 -o one.glb").status, 0);
    ASSERT_EQ(nacre(build + " --threads 4 -o four.glb").status, 0);
    EXPECT_EQ(testing::read_bytes(folder_.path() / "one.glb"),
              testing::read_bytes(folder_.path() / "four.glb"));
  }
}

TEST_F(ShellCommand, SetsAreMadeSmallWhereTheyAreSimplifiedUnlessAsked) {
  const auto bytes = [&](const std::string& extra) {
    const std::string build =
        "build ball.nii --window 0,28 --levels 7 --certificate none -o c.glb ";
    EXPECT_EQ(nacre(build + extra).status, 0) << extra;
    return testing::read_bytes(folder_.path() / "c.glb");
  };
  EXPECT_EQ(bytes(""), bytes("--compression 8"));
  EXPECT_EQ(bytes("--tolerance 0.02"), bytes("--tolerance 0.02 --compression 10"));
  EXPECT_EQ(bytes("--tolerance-mm 0.1"), bytes("--tolerance-mm 0.1 --compression 10"));
  EXPECT_LT(bytes("--compression 10").size(), bytes("--compression 8").size());
  // The surfaces are the same.
  EXPECT_EQ(nacre("verify c.glb --volume ball.nii").status, 0);
  expect_refusal("build ball.nii -o c.glb --compression 11", 2, "--compression");
  expect_refusal("render ball.nii --method shells --compression 3 -o c.png", 2, "--compression");
}

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

TEST_F(ShellCommand, ACertificateMayBeLeftOut) {
  EXPECT_FALSE(json::parse(nacre("info ball.glb --json -").output).contains("certificate"));
  EXPECT_EQ(nacre("info ball.glb").output.find("certified"), std::string::npos);
  expect_refusal("build ball.nii --certificate big -o c.glb", 2, "--certificate: found 'big'");
  expect_refusal("build ball.nii --certificate 0x5 -o c.glb", 2, "from 1 to 32768");
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

TEST_F(ShellCommand, PruningIsToldAndStored) {
  const CommandResult result = nacre(
      "build ball.nii --window 0,28 --levels 7 --min-component 1e9 --certificate none -o none.glb "
      "--json -");
  ASSERT_EQ(result.status, 0) << result.errors;
  const json figures = json::parse(result.output);
  EXPECT_EQ(figures["triangles"], 0);
  ASSERT_EQ(figures["left_out"].size(), 1u);
  EXPECT_NE(figures["left_out"][0]["what"].get<std::string>().find("specks"), std::string::npos);
  EXPECT_GT(figures["left_out"][0]["largest_emission"].get<double>(), 0.7);
  const json info = json::parse(nacre("info none.glb --json -").output);
  EXPECT_GT(info["pruned"]["specks"]["components"].get<int>(), 0);
  expect_refusal("build ball.nii --keep-specks --min-component 1 -o a.glb", 2, "keep-specks");
}

TEST_F(ShellCommand, ABudgetHoldsAndALargerOneGivesNoWorsePicture) {
  const std::string build =
      "build ball.nii --window 0,28 --certificate 32x32 -o b.glb --json - --budget ";
  double before = 0.0;
  for (const std::size_t bytes : {6500, 11500}) {
    const CommandResult result = nacre(build + std::to_string(bytes));
    ASSERT_EQ(result.status, 0) << result.errors;
    EXPECT_EQ(result.errors.find("warning"), std::string::npos) << result.errors;
    EXPECT_LE(std::filesystem::file_size(folder_.path() / "b.glb"), bytes);
    const json figures = json::parse(result.output);
    const double psnr_db = figures["certificate"]["max_fine"]["psnr_db"];
    EXPECT_GE(psnr_db, before) << bytes;
    before = psnr_db;
    for (const json& trial : figures["budget"]["trials"]) {
      EXPECT_EQ(trial["fits"].get<bool>(), trial["bytes"].get<std::size_t>() <= bytes);
      if (!trial["chosen"].get<bool>()) continue;
      // What was measured to choose it is what its certificate states.
      EXPECT_NEAR(trial["psnr_db"].get<double>(), psnr_db, 1e-3);
    }
  }
}

TEST_F(ShellCommand, ABudgetOfTrianglesHolds) {
  const json figures = json::parse(
      nacre("build ball.nii --window 0,28 --certificate 8x8 --budget 0.4ktri -o b.glb --json -")
          .output);
  EXPECT_LE(figures["triangles"].get<int>(), 400);
  EXPECT_EQ(figures["budget"]["unit"], "triangles");
  EXPECT_EQ(figures["budget"]["most"], 400);
}

TEST_F(ShellCommand, ABudgetHoldsWhatOtherFlagsName) {
  const json figures = json::parse(nacre("build ball.nii --window 0,28 --certificate 8x8 --levels "
                                         "5 --quantization 9 --budget 20kB -o b.glb --json -")
                                       .output);
  EXPECT_EQ(figures["levels"].size(), 5u);
  ASSERT_GE(figures["budget"]["trials"].size(), 2u);
  for (const json& trial : figures["budget"]["trials"]) {
    EXPECT_EQ(trial["levels"], 5);
    EXPECT_EQ(trial["bits"], 9);
  }
}

TEST_F(ShellCommand, ATolerancesWeightIsWhatIsAskedAndIsKept) {
  const std::string build = "build ball.nii --window 0,28 --levels 6 --certificate none ";
  const auto triangles = [&](const std::string& flags) {
    const CommandResult result = nacre(build + flags + " -o w.glb --json -");
    EXPECT_EQ(result.status, 0) << result.errors;
    EXPECT_EQ(nacre("verify w.glb --volume ball.nii").status, 0) << flags;
    return json::parse(result.output)["triangles"].get<int>();
  };
  const int even = triangles("--tolerance 0.15");
  EXPECT_EQ(triangles("--tolerance 0.15 --tolerance-weight field"), even);
  const std::string words = "less where maxima show more";
  EXPECT_EQ(json::parse(nacre("info w.glb --json -").output)["tolerance_weight"], "field");
  EXPECT_EQ(nacre("info w.glb").output.find(words), std::string::npos);
  EXPECT_GT(triangles("--tolerance 0.15 --tolerance-weight picture"), even);
  EXPECT_EQ(json::parse(nacre("info w.glb --json -").output)["tolerance_weight"], "picture");
  EXPECT_NE(nacre("info w.glb").output.find(words), std::string::npos);
  expect_refusal(build + "--tolerance 0.1 --tolerance-weight much -o w.glb", 2, "tolerance-weight");
  for (const std::string flags : {"", "--tolerance 0 ", "--tolerance-mm 0.5 "}) {
    expect_refusal(build + flags + "--tolerance-weight picture -o w.glb", 2,
                   "--tolerance-weight: found picture and no --tolerance");
  }
}

TEST_F(ShellCommand, ABudgetSaysTheFlagsThatMakeItsSetAgain) {
  const std::string build = "build ball.nii --window 0,28 --certificate 8x8 ";
  const CommandResult result = nacre(build + "--budget 12kB -o b.glb");
  ASSERT_EQ(result.status, 0) << result.errors;
  const std::string chosen = "chosen: ";
  const std::size_t begin = result.output.find(chosen) + chosen.size();
  ASSERT_GE(begin, chosen.size()) << result.output;
  const std::string flags = result.output.substr(begin, result.output.find('\n', begin) - begin);
  ASSERT_EQ(nacre(build + flags + " -o again.glb").status, 0) << flags;
  EXPECT_EQ(testing::read_bytes(folder_.path() / "again.glb"),
            testing::read_bytes(folder_.path() / "b.glb"))
      << flags;
}

TEST_F(ShellCommand, ABudgetWeighsWhatToleranceItChoosesUnlessAsked) {
  const auto trial = [&](const std::string& flags) {
    const CommandResult result = nacre(
        "build ball.nii --window 0,28 --certificate 8x8 --budget 20kB -o b.glb --json - " + flags);
    EXPECT_EQ(result.status, 0) << result.errors;
    return json::parse(result.output)["budget"]["trials"].back();
  };
  EXPECT_EQ(trial("")["tolerance_weight"], "picture");
  EXPECT_EQ(trial("--tolerance-weight field")["tolerance_weight"], "field");
  EXPECT_EQ(trial("--tolerance 0.1")["tolerance_weight"], "field");
  EXPECT_EQ(trial("--tolerance 0.1 --tolerance-weight picture")["tolerance_weight"], "picture");
}

TEST_F(ShellCommand, ABudgetGivesTheSameBytesForAnyNumberOfThreads) {
  const std::string build = "build ball.nii --budget 9kB --certificate 20x20";
  ASSERT_EQ(nacre(build + " --threads 1 -o one.glb").status, 0);
  ASSERT_EQ(nacre(build + " --threads 4 -o four.glb").status, 0);
  EXPECT_EQ(testing::read_bytes(folder_.path() / "one.glb"),
            testing::read_bytes(folder_.path() / "four.glb"));
}

TEST_F(ShellCommand, ABudgetThatNothingFitsIsRefusedInOneLine) {
  expect_refusal("build ball.nii --window 0,28 --budget 100 -o b.glb", 2,
                 "--budget: found 100 bytes, expected");
  expect_refusal("build ball.nii --window 0,28 --budget 1tri -o b.glb", 2,
                 "--budget: found 1 triangles, expected");
  for (const std::string text : {"much", "-2MB", "0", "2MBs", "nan", "1e99MB", "0.5tri"}) {
    expect_refusal("build ball.nii --budget=" + text + " -o b.glb", 2, "--budget: found '" + text);
  }
}

TEST_F(ShellCommand, PlacementIsChosenOrAsked) {
  const auto placement = [&](const std::string& flags) {
    const CommandResult result =
        nacre("build ball.nii --window 0,300 --levels 5 --certificate none " + flags +
              " -o p.glb --json -");
    EXPECT_EQ(result.status, 0) << result.errors;
    return json::parse(result.output)["placement"].get<std::string>();
  };
  EXPECT_EQ(placement(""), "optimal");  // a window ten times as wide as what is in it
  EXPECT_EQ(placement("--placement optimal"), "optimal");
  EXPECT_EQ(placement("--placement uniform"), "uniform");
}

}  // namespace
}  // namespace nacre

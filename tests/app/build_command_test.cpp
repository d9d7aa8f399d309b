// `nacre build`: levels, tolerances, placement, pruning, budgets, and what it says of them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/shell_command.h"

namespace nacre {
namespace {

using nlohmann::json;
using testing::CommandResult;
using testing::ShellCommand;

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

TEST_F(ShellCommand, ACertificateMayBeLeftOut) {
  EXPECT_FALSE(json::parse(nacre("info ball.glb --json -").output).contains("certificate"));
  EXPECT_EQ(nacre("info ball.glb").output.find("certified"), std::string::npos);
  expect_refusal("build ball.nii --certificate big -o c.glb", 2, "--certificate: found 'big'");
  expect_refusal("build ball.nii --certificate 0x5 -o c.glb", 2, "from 1 to 32768");
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

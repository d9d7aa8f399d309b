// Coarse copies in a file: `nacre render --coarse` draws them, they are as wrong as the file
// states, and `nacre verify` checks them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "tests/support/command_test.h"

namespace nacre {
namespace {

using nlohmann::json;

/// A set of a small phantom with coarse copies.
class CoarseCopies : public testing::CommandTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(nacre("phantom torus --size 20,18,16 -o t.nii").status, 0);
    ASSERT_EQ(nacre("build t.nii --levels 4 --tolerance 0.005 --certificate 64x64 --coarse 0.125 "
                    "-o set.glb")
                  .status,
              0);
  }

  json figures(const std::string& arguments, int status = 0) const {
    const testing::CommandResult result = nacre(arguments + " -q --json -");
    EXPECT_EQ(result.status, status) << arguments << "\n" << result.errors;
    return json::parse(result.output);
  }

  /// Mean squared error of pictures of the copies beside the exact ones.
  double squared_error(const std::string& measured, const std::string& views,
                       const std::string& number) const {
    const std::string mode = measured == "sum" ? "sum" : "max";
    const std::string layers = measured == "max" ? " --layers flat" : "";
    const std::string scene = " --size 64x64 --mode " + mode + " " + views;
    figures("reference t.nii -o exact" + number + ".tif" + scene);
    figures("render set.glb --backend osmesa --coarse -o copies" + number + ".tif" + scene +
            layers);
    const json error = figures("compare copies" + number + ".tif exact" + number + ".tif");
    return std::pow(error.at("all").at("rmse").get<double>(), 2);
  }

  /// Over the seven views of docs/shell_file.md's certificate: of the first four here, two are the
  /// other two from behind.
  double root_mean_square(const std::string& mode) const {
    const double around = squared_error(mode, "--turntable 4", "%d");
    const double diagonal = squared_error(mode, "--turntable 4 --azimuth 45 --elevation 35", "%d");
    const double above = squared_error(mode, "--view superior", "");
    return std::sqrt((2.0 * around + 4.0 * diagonal + above) / 7.0);
  }
};

TEST_F(CoarseCopies, AreAsFarFromTheExactPicturesAsTheFileStates) {
  const json stated = figures("info set.glb").at("coarse");
  for (const std::string mode : {"max", "max_fine", "sum"}) {
    const double rmse = stated.at(mode).at("rmse").get<double>();
    EXPECT_NEAR(root_mean_square(mode), rmse, 0.02 * rmse) << mode;  // drawn, not by rays
  }
  const json certified = figures("info set.glb").at("certificate");
  EXPECT_LT(stated.at("max").at("psnr_db"), certified.at("max").at("psnr_db"));
  EXPECT_LT(stated.at("sum").at("psnr_db"), certified.at("sum").at("psnr_db"));
}

// What is stated of maxima holds for nothing else.
TEST_F(CoarseCopies, AreSaidWithTheErrorOfThePictureDrawn) {
  const json stated = figures("info set.glb").at("coarse");
  EXPECT_EQ(stated.at("tolerance"), 0.125);
  const std::string render = "render set.glb --backend osmesa --size 64x64 -o a.tif ";
  for (const auto& [flags, stated_as, words] : {std::tuple{"max", "max_fine", "error of maxima: "},
                                                {"max --layers flat", "max", "error of maxima: "},
                                                {"sum", "sum", "error of sums: "}}) {
    const std::string text = nacre(render + "--coarse --explain --mode " + flags).output;
    const std::size_t at = text.find(words);
    ASSERT_NE(at, std::string::npos) << text;
    EXPECT_NEAR(std::stod(text.substr(at + std::strlen(words))),
                stated.at(stated_as).at("psnr_db").get<double>(), 0.01);
    EXPECT_EQ(text.find("psnr_db"), std::string::npos) << "words, not JSON: " << text;
  }
  const json iso = figures(render + "--coarse --mode iso");
  EXPECT_EQ(iso.at("coarse").count("max") + iso.at("coarse").count("sum"), 0u);
  const json shells = figures(render + "--mode iso");
  EXPECT_EQ(shells.count("coarse"), 0u);
  EXPECT_LT(iso.at("triangles_drawn"), shells.at("triangles_drawn"));
}

TEST_F(CoarseCopies, AreRefusedWhereThereAreNone) {
  ASSERT_EQ(nacre("build t.nii --levels 4 --certificate none -o plain.glb").status, 0);
  expect_refusal("render plain.glb --coarse -o c.png", 2, "found no coarse copies");
  expect_refusal("render t.nii --coarse -o c.png", 2, "found no .glb file");
}

using CoarseFlag = testing::CommandTest;

// A volume that is not there would be missed first.
TEST_F(CoarseFlag, BadTolerancesAreRefusedBeforeTheVolumeIsRead) {
  const std::string build = "build none.nii -o c.glb --tolerance 0.01 --coarse ";
  expect_refusal(build + "much", 2, "--coarse: found much");
  expect_refusal(build + "0.01", 2, "--coarse: found 0.01");
  expect_refusal(build + "1.5", 2, "--coarse: found 1.5");
  expect_refusal("build none.nii -o c.glb --coarse 0.1", 2, "expected --tolerance");
}

TEST_F(CoarseCopies, AreVerified) {
  const json found = figures("verify set.glb --volume t.nii");
  EXPECT_TRUE(found.at("kept").get<bool>()) << found.at("broken");
  const json& copies = found.at("copies");
  EXPECT_EQ(copies.at("tolerance"), 0.125);
  const json& shells = found.at("shells");
  ASSERT_EQ(copies.at("shells").size(), shells.size());
  for (std::size_t k = 0; k < shells.size(); ++k) {
    const json& copy = copies.at("shells")[k];
    EXPECT_EQ(copy.at("name"), shells[k].at("name"));
    EXPECT_LT(copy.at("triangles"), shells[k].at("triangles"));
    EXPECT_EQ(copy.at("euler"), shells[k].at("euler"));
    EXPECT_GT(copy.at("volume").at("rms_error"), shells[k].at("volume").at("rms_error"));
  }
  const std::string said = nacre("verify set.glb").output;
  EXPECT_NE(said.find("\ncopy 4 "), std::string::npos) << said;
  EXPECT_NE(said.find("4 coarse copies, "), std::string::npos) << said;
}

TEST_F(CoarseCopies, VerifyFindsWhatIsWrongWithThem) {
  const std::string set = testing::read_bytes(folder_.path() / "set.glb");
  std::string file = set;
  const std::string true_text = R"("coarse":{"tolerance":0.125)";
  const std::size_t at = file.find(true_text);
  ASSERT_NE(at, std::string::npos);
  folder_.write("set.glb", file.replace(at, true_text.size(), R"("coarse":{"tolerance":0.001)"));
  json found = figures("verify set.glb --volume t.nii", 1);
  EXPECT_NE(found.at("broken").dump().find("copy 1: found an emission error of"), std::string::npos)
      << found.at("broken");

  file = set;
  file[file.size() - 40] ^= 1;  // the last copy's bytes end the file
  folder_.write("set.glb", file);
  found = figures("verify set.glb", 1);
  EXPECT_NE(found.at("broken").dump().find("checksum"), std::string::npos) << found.at("broken");
}

}  // namespace
}  // namespace nacre

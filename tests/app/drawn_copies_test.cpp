// `nacre render --coarse`: the copies are drawn, and are as wrong as the file states.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/command_test.h"

namespace nacre {
namespace {

using nlohmann::json;

/// A set of a small phantom with coarse copies.
class DrawnCopies : public testing::CommandTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(nacre("phantom torus --size 28,26,24 -o t.nii").status, 0);
    ASSERT_EQ(nacre("build t.nii --levels 8 --tolerance 0.005 --certificate 96x96 --coarse 0.1 "
                    "-o set.glb")
                  .status,
              0);
  }

  json figures(const std::string& arguments) const {
    const testing::CommandResult result = nacre(arguments + " -q --json -");
    EXPECT_EQ(result.status, 0) << arguments << "\n" << result.errors;
    return json::parse(result.output);
  }
};

// The seven views of docs/shell_file.md's certificate, one mean squared error over all.
TEST_F(DrawnCopies, AreAsFarFromTheExactPictureAsTheFileStates) {
  constexpr std::array kViews = {"--view anterior",
                                 "--azimuth 90",
                                 "--view superior",
                                 "--azimuth 45 --elevation 35",
                                 "--azimuth 135 --elevation 35",
                                 "--azimuth 225 --elevation 35",
                                 "--azimuth 315 --elevation 35"};
  double copies = 0.0;
  double shells = 0.0;
  for (const std::string view : kViews) {
    const std::string scene = " --size 96x96 " + view;
    figures("reference t.nii -o exact.tif" + scene);
    figures("render set.glb --backend cpu --coarse -o copies.tif" + scene);
    figures("render set.glb --backend cpu -o shells.tif" + scene);
    copies +=
        std::pow(figures("compare copies.tif exact.tif").at("all").at("rmse").get<double>(), 2);
    shells +=
        std::pow(figures("compare shells.tif exact.tif").at("all").at("rmse").get<double>(), 2);
  }
  const json drawn = figures("render set.glb --backend cpu --coarse -o a.tif --size 96x96");
  const double measured_db = -10.0 * std::log10(copies / kViews.size());
  EXPECT_NEAR(measured_db, drawn.at("coarse").at("max").at("psnr_db").get<double>(), 0.1);
  EXPECT_GT(copies, shells);
}

TEST_F(DrawnCopies, AreSaidAndHaveFewerTriangles) {
  const json copies = figures("render set.glb --backend cpu --coarse -o a.tif");
  const json shells = figures("render set.glb --backend cpu -o b.tif");
  EXPECT_EQ(shells.count("coarse"), 0u);
  EXPECT_EQ(copies.at("coarse").at("tolerance"), 0.1);
  EXPECT_LT(copies.at("triangles_drawn"), shells.at("triangles_drawn"));
  const auto said = nacre("render set.glb --backend cpu --coarse --explain -o a.tif");
  EXPECT_NE(said.output.find("coarse copies of"), std::string::npos) << said.output;
  EXPECT_NE(said.output.find("psnr_db"), std::string::npos) << said.output;
}

TEST_F(DrawnCopies, AreRefusedWhereThereAreNone) {
  ASSERT_EQ(nacre("build t.nii --levels 4 --certificate none -o plain.glb").status, 0);
  expect_refusal("render plain.glb --coarse -o c.png", 2, "found no coarse copies");
  expect_refusal("render t.nii --coarse -o c.png", 2, "found a volume");
}

}  // namespace
}  // namespace nacre

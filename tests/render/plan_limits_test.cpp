// A plan says where a scene goes past what the chosen formats hold, and only there.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "render/plan.h"

namespace nacre {
namespace {

const BoundingSphere kSphere{{0.0, 0.0, 0.0}, 60.0};

Box cube(double half_side) { return {glm::dvec3(-half_side), glm::dvec3(half_side)}; }

/// Nested cubes of sides from 60 mm down, emissions k / n times `brightest`.
SceneFacts cubes(int count, double brightest = 1.0) {
  SceneFacts scene;
  for (int k = 1; k <= count; ++k) {
    scene.shells.push_back({brightest * k / count, 12, cube(30.0 - 20.0 * (k - 1) / count)});
  }
  return scene;
}

std::vector<std::string> warnings(const SceneFacts& scene, const RenderOptions& options) {
  return make_plan(scene, make_camera({}, kSphere), options).warnings;
}

void expect_one(const std::vector<std::string>& found, const std::string& part) {
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found.front().find(part), std::string::npos) << found.front();
}

TEST(PlanLimits, UsualScenesInUsualFormatsWarnOfNothing) {
  for (const PictureMode mode :
       {PictureMode::Max, PictureMode::Sum, PictureMode::Count, PictureMode::Iso}) {
    EXPECT_TRUE(warnings(cubes(48), {.mode = mode}).empty());
    EXPECT_TRUE(warnings(cubes(24), {.mode = mode, .target = TargetFormat::F16}).empty());
  }
}

TEST(PlanLimits, SumsThatHalfFloatsEndWarn) {
  // 60 mm at a cue of 1000 are 60000, at 1200 they are 72000.
  const RenderOptions half{.mode = PictureMode::Sum, .target = TargetFormat::F16};
  RenderOptions bright = half;
  bright.cue = {.a = 0.0, .b = 1000.0};
  EXPECT_TRUE(warnings(cubes(12), bright).empty());
  bright.cue.b = 1200.0;
  expect_one(warnings(cubes(12), bright), "pixels may reach 7.2e+04, and end at 65504");
  bright.target = TargetFormat::F32;
  EXPECT_TRUE(warnings(cubes(12), bright).empty());
}

TEST(PlanLimits, RoundingsOfManyLayersInHalfFloatsWarn) {
  for (const PictureMode mode : {PictureMode::Sum, PictureMode::Count}) {
    const RenderOptions half{.mode = mode, .target = TargetFormat::F16};
    EXPECT_TRUE(warnings(cubes(100), half).empty());
    expect_one(warnings(cubes(205), half), "205 shells may add up to 20 % of a pixel");
  }
}

TEST(PlanLimits, CountsThatEightBitsEndWarn) {
  const RenderOptions bytes{.mode = PictureMode::Count, .target = TargetFormat::U8};
  EXPECT_TRUE(warnings(cubes(1, 0.5), bytes).empty());
  expect_one(warnings(cubes(3), bytes), "counts may reach 4, and end at 1");
}

TEST(PlanLimits, ShellsUnderHalfAStepOfACuedMaximumWarn) {
  SceneFacts scene = cubes(2);
  scene.shells[0].representative = 1e-6;
  RenderOptions cued{.cue = {.a = 0.5, .b = 0.5}, .depth = DepthFormat::D16};
  expect_one(warnings(scene, cued), "shell 1 (12 triangles) black: under the cue");
  cued.depth = DepthFormat::D24;
  EXPECT_TRUE(warnings(scene, cued).empty());
  cued = {.depth = DepthFormat::D16};  // ranks keep any emission
  EXPECT_TRUE(warnings(scene, cued).empty());
}

TEST(PlanLimits, ToolsByPassesThatADepthBufferTellsFromShellsByMoreThanAPixelWarn) {
  SceneFacts scene = cubes(200);
  scene.tools.push_back({12, cube(25.0)});
  RenderOptions passes{.depth = DepthFormat::D16, .occlusion = Occlusion::Passes};
  expect_one(warnings(scene, passes), "tell tools from shells to 0.366 mm");
  passes.depth = DepthFormat::D24;
  EXPECT_TRUE(warnings(scene, passes).empty());
  passes = {.depth = DepthFormat::D16, .occlusion = Occlusion::Texture};
  EXPECT_TRUE(warnings(scene, passes).empty());
}

}  // namespace
}  // namespace nacre

#include "render/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/error.h"

namespace nacre {
namespace {

const BoundingSphere kSphere{{10.0, 20.0, 30.0}, 50.0};

Box cube(double half_side) { return {glm::dvec3(-half_side), glm::dvec3(half_side)}; }

/// Three nested shells of 100, 50 and 10 triangles.
SceneFacts scene() {
  return {kSphere.center_mm,
          {{1.0 / 3.0, 100, cube(25.0)}, {2.0 / 3.0, 50, cube(15.0)}, {1.0, 10, cube(5.0)}}};
}

Plan plan_of(const SceneFacts& facts, const RenderOptions& options = {},
             const CameraOptions& camera = {}) {
  return make_plan(facts, make_camera(camera, kSphere), options);
}

/// Why the plan left something out; empty if it did not.
std::string why(const Plan& plan, const std::string& what) {
  const auto found = std::find_if(plan.left_out.begin(), plan.left_out.end(),
                                  [&](const LeftOut& item) { return item.what == what; });
  return found == plan.left_out.end() ? "" : found->why;
}

TEST(Plan, DrawsRanksBrightestFirst) {
  const Plan plan = plan_of(scene());
  ASSERT_EQ(plan.passes.size(), 1U);
  const std::vector<ShellDraw>& draws = plan.passes[0].draws;
  ASSERT_EQ(draws.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(draws[i].shell, 2 - i);
    EXPECT_DOUBLE_EQ(draws[i].depth_at_near, static_cast<double>(3 - i) / 3.0);
    EXPECT_EQ(draws[i].depth_at_near, draws[i].depth_at_far);
  }
  EXPECT_EQ(plan.emission_of_rank, (std::vector<float>{0.0F, 1.0F / 3.0F, 2.0F / 3.0F, 1.0F}));
  EXPECT_EQ(shells_drawn(plan), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(describe(plan.passes[0]), "max as depth: 3 shells, 160 triangles");
}

TEST(Plan, EstimatesBetweenLevelsWhereAPixelTellsItsLayer) {
  SceneFacts facts = scene();
  double level = 0.5;
  for (ShellFacts& shell : facts.shells) shell.emission = level++ / 3.0;
  const RenderOptions smooth{.layers = Layers::Smooth};
  EXPECT_TRUE(plan_of(facts).layers.empty());
  EXPECT_EQ(why(plan_of(facts), "smooth layers"), "");
  const Plan plan = plan_of(facts, smooth);
  ASSERT_EQ(plan.layers.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(plan.layers[i].shown, plan.emission_of_rank[i]);
  EXPECT_FLOAT_EQ(plan.layers[2].lo, 0.5F);
  EXPECT_EQ(plan.samples, 1);

  RenderOptions other = smooth;
  other.cue = {.a = 0.0, .b = 0.7};  // one factor
  const Plan dimmed = plan_of(facts, other);
  ASSERT_EQ(dimmed.layers.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(dimmed.layers[i].shown, dimmed.emission_of_rank[i]);
  }
  other.cue = {.a = 0.5, .b = 0.5};
  EXPECT_NE(why(plan_of(facts, other), "smooth layers").find("cue"), std::string::npos);
  other = smooth;
  other.hidden = {1};
  EXPECT_NE(why(plan_of(facts, other), "smooth layers").find("hidden"), std::string::npos);
  other = smooth;
  other.mode = PictureMode::Sum;
  EXPECT_TRUE(plan_of(facts, other).layers.empty());
  facts.shells[1].emission = 0.7;  // above what it is shown as
  EXPECT_NE(why(plan_of(facts, smooth), "smooth layers").find("outside its layer"),
            std::string::npos);
}

TEST(Plan, FineLayersTakeNineRaysAPixelWherePicturesAreNotLarge) {
  SceneFacts facts = scene();
  double level = 0.5;
  for (ShellFacts& shell : facts.shells) shell.emission = level++ / 3.0;
  const Plan plan = plan_of(facts, {.layers = Layers::Fine});
  EXPECT_EQ(plan.samples, 3);
  EXPECT_EQ(layers_drawn(plan), Layers::Fine);
  const PixelRect& last = plan.tiles.back();
  EXPECT_EQ(last.x + last.width, 3 * CameraOptions{}.size.x);
  EXPECT_EQ(last.y + last.height, 3 * CameraOptions{}.size.y);
  Camera large = make_camera({}, kSphere);
  large.size = {1200, 1200};  // more with tools' ends to each ray than without
  EXPECT_EQ(layers_drawn(make_plan(facts, large, {.layers = Layers::Fine}, {})), Layers::Fine);
  facts.tools = {{.triangles = 12, .bounds = facts.shells[1].bounds}};
  EXPECT_EQ(layers_drawn(make_plan(facts, large, {.layers = Layers::Fine}, {})), Layers::Smooth);
  facts.tools.clear();
  large.size = {8192, 2048};  // nine times 17 million rays
  const Plan coarse = make_plan(facts, large, {.layers = Layers::Fine}, {});
  EXPECT_EQ(layers_drawn(coarse), Layers::Smooth);
  EXPECT_NE(why(coarse, "fine layers").find("large"), std::string::npos);
}

// A shell that no ray can meet has no rank, and the layer below ends where it would begin.
TEST(Plan, LayersAreThoseOfTheRanks) {
  SceneFacts facts = scene();
  double level = 0.5;
  for (ShellFacts& shell : facts.shells) shell.emission = level++ / 3.0;
  facts.shells[1].triangles = 0;
  const Plan plan = plan_of(facts, {.layers = Layers::Smooth});
  ASSERT_EQ(plan.layers.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(plan.layers[i].shown, plan.emission_of_rank[i]);
  EXPECT_FLOAT_EQ(plan.layers[1].hi, 0.5F);
  EXPECT_FLOAT_EQ(plan.layers[2].lo, 2.5F / 3.0F);
}

TEST(Plan, LeavesOutHiddenShells) {
  const Plan plan = plan_of(scene(), {.hidden = {2, 0}});
  EXPECT_EQ(shells_drawn(plan), std::vector<std::uint32_t>{1});
  EXPECT_EQ(why(plan, "shells 1, 3 (110 triangles)"),
            "hidden: the layer shows the previous shown shell");
}

TEST(Plan, LeavesOutEmptyShells) {
  SceneFacts facts = scene();
  facts.shells[1].triangles = 0;
  EXPECT_EQ(shells_drawn(plan_of(facts)), (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(why(plan_of(facts), "shell 2 (0 triangles)"), "empty: nothing reaches the level");
  const RenderOptions all{.rules = {.leave_out_empty = false}};
  EXPECT_EQ(shells_drawn(plan_of(facts, all)).size(), 3U);
}

TEST(Plan, LeavesOutDarkShells) {
  SceneFacts facts = scene();
  facts.shells[0].representative = 0.0;
  EXPECT_EQ(shells_drawn(plan_of(facts)), (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(why(plan_of(facts), "shell 1 (100 triangles)"), "dark: the emission shown is 0");
  const RenderOptions all{.rules = {.leave_out_dark = false}};
  EXPECT_EQ(shells_drawn(plan_of(facts, all)).size(), 3U);
}

TEST(Plan, LeavesOutShellsOutsideTheView) {
  // Beside the inner two, level with the outer one.
  const CameraOptions aside{.zoom = 10.0, .look_at_mm = kSphere.center_mm + glm::dvec3(25, 0, 0)};
  const Plan plan = plan_of(scene(), {}, aside);
  EXPECT_EQ(shells_drawn(plan), std::vector<std::uint32_t>{0});
  EXPECT_EQ(why(plan, "shells 2-3 (60 triangles)"), "outside the view");
  const RenderOptions all{.rules = {.leave_out_outside_view = false}};
  EXPECT_EQ(shells_drawn(plan_of(scene(), all, aside)).size(), 3U);
}

TEST(Plan, PlansNoPassForABlackPicture) {
  EXPECT_TRUE(plan_of({}).passes.empty());
  EXPECT_TRUE(plan_of(scene(), {.hidden = {0, 1, 2}}).passes.empty());
}

TEST(Plan, DrawsFrontFacesWhereTheEyeIsOutside) {
  for (const CameraOptions& camera : {CameraOptions{}, CameraOptions{.field_of_view_rad = 0.7}}) {
    const Plan plan = plan_of(scene(), {}, camera);
    for (const ShellDraw& draw : plan.passes.at(0).draws) EXPECT_EQ(draw.faces, Faces::Front);
    EXPECT_NE(why(plan, "back faces of shells 1-3 (160 triangles)"), "");
  }
}

TEST(Plan, DrawsBackFacesWhereTheEyeMayBeInside) {
  const Plan plan = plan_of(scene(), {}, {.field_of_view_rad = 0.7, .distance_mm = 10.0});
  const std::vector<ShellDraw>& draws = plan.passes.at(0).draws;
  EXPECT_EQ(draws.at(0).faces, Faces::Front);
  EXPECT_EQ(draws.at(1).faces, Faces::Back);
  EXPECT_EQ(draws.at(2).faces, Faces::Back);
  EXPECT_NE(why(plan, "back faces of shell 3 (10 triangles)"), "");
  EXPECT_NE(why(plan, "front faces of shells 1-2 (150 triangles)"), "");
}

TEST(Plan, DrawsAllFacesWithTheRuleOff) {
  const Plan plan = plan_of(scene(), {.rules = {.cull_faces = false}});
  for (const ShellDraw& draw : plan.passes.at(0).draws) EXPECT_EQ(draw.faces, Faces::Both);
  EXPECT_EQ(why(plan, "back faces of shells 1-3 (160 triangles)"), "");
}

TEST(Plan, SharesARankAmongEqualRepresentatives) {
  SceneFacts facts = scene();
  facts.shells[1].representative = 1.0;
  const Plan plan = plan_of(facts);
  EXPECT_EQ(plan.emission_of_rank, (std::vector<float>{0.0F, 1.0F / 3.0F, 1.0F}));
  EXPECT_EQ(plan.passes.at(0).draws.at(1).depth_at_near, 1.0);
}

TEST(Plan, AppliesAFlatCueToTheEmissions) {
  const Plan plan = plan_of(scene(), {.cue = {.a = 0.0, .b = 0.5, .beta0 = 0.25}});
  EXPECT_EQ(plan.emission_of_rank, (std::vector<float>{0.0F, 0.25F, 0.5F, 0.75F}));
  EXPECT_EQ(why(plan, "depth cue"), "a = 0: one factor for all depths");
}

TEST(Plan, CutsLargePicturesIntoTiles) {
  const Camera camera = make_camera({.size = {250, 100}}, kSphere);
  const Plan plan = make_plan(scene(), camera, {}, {.max_target_side = 100});
  ASSERT_EQ(plan.tiles.size(), 3U);
  EXPECT_EQ(plan.tiles[2].x, 200);
  EXPECT_EQ(plan.tiles[2].width, 50);
  EXPECT_EQ(plan.tiles[2].height, 100);
}

void expect_error(ErrorCode code, const SceneFacts& facts, const RenderOptions& options) {
  try {
    plan_of(facts, options);
    FAIL() << "expected nacre::Error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
  }
}

TEST(Plan, RefusesWrongOptions) {
  expect_error(ErrorCode::BadArgument, scene(), {.hidden = {3}});
  expect_error(ErrorCode::BadArgument, scene(), {.cue = {.a = 0.0, .b = -1.0}});
  expect_error(ErrorCode::BadArgument, scene(), {.cue = {.a = -2.0, .b = 1.0}});
  expect_error(ErrorCode::BadArgument, scene(),
               {.cue = {.b = std::numeric_limits<double>::quiet_NaN()}});
}

TEST(Plan, RefusesEmptySlabsAndSumsInEightBits) {
  expect_error(ErrorCode::BadArgument, scene(), {.slab = {.near_mm = 5.0, .far_mm = 5.0}});
  expect_error(ErrorCode::BadArgument, scene(),
               {.mode = PictureMode::Sum, .target = TargetFormat::U8});
}

TEST(Plan, RefusesMoreShellsThanTheDepthKeepsApart) {
  SceneFacts facts;
  for (int k = 1; k <= 20000; ++k) facts.shells.push_back({k / 20000.0, 1, cube(5.0)});
  expect_error(ErrorCode::Unsupported, facts, {.depth = DepthFormat::D16});
  EXPECT_EQ(plan_of(facts, {.depth = DepthFormat::D24}).emission_of_rank.size(), 20001U);
}

TEST(SceneFacts, BoundsWhatItHolds) {
  ShellSet set;
  set.center_mm = {1, 2, 3};
  set.shells.resize(2);
  set.shells[0].representative = 0.5;
  set.shells[0].surface = {{{1, 2, 3}, {-1, 5, 0}, {0, 0, 4}}, {{0, 1, 2}}};
  const SceneFacts facts = scene_facts(set);
  EXPECT_EQ(facts.center_mm, glm::dvec3(1, 2, 3));
  ASSERT_EQ(facts.shells.size(), 2U);
  EXPECT_EQ(facts.shells[0].representative, 0.5);
  EXPECT_EQ(facts.shells[0].triangles, 1U);
  EXPECT_EQ(facts.shells[0].bounds.lo, glm::dvec3(-1, 0, 0));
  EXPECT_EQ(facts.shells[0].bounds.hi, glm::dvec3(1, 5, 4));
  EXPECT_EQ(facts.shells[1].triangles, 0U);
}

TEST(RenderOptions, NamesAreRoundTrips) {
  for (const char* wanted : {"8", "16f", "32f"}) EXPECT_EQ(name(*target_format(wanted)), wanted);
  for (const char* wanted : {"auto", "passes", "texture"}) {
    EXPECT_EQ(name(*occlusion(wanted)), wanted);
  }
  EXPECT_FALSE(target_format("16").has_value());
  EXPECT_FALSE(occlusion("depth").has_value());
}

TEST(RenderOptions, DepthFormatsAreRoundTrips) {
  for (const char* wanted : {"16", "24", "32f"}) {
    ASSERT_TRUE(depth_format(wanted).has_value());
    EXPECT_EQ(name(*depth_format(wanted)), wanted);
  }
  EXPECT_FALSE(depth_format("8").has_value());
}

}  // namespace
}  // namespace nacre

// Plans of cues, tools, slabs and the modes beside the plain maximum.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/vec3.hpp>

#include "render/plan.h"

namespace nacre {
namespace {

const BoundingSphere kSphere{{10.0, 20.0, 30.0}, 50.0};

Box cube(double half_side, const glm::dvec3& center = glm::dvec3(0.0)) {
  return {center - half_side, center + half_side};
}

/// Three nested shells of 10,000, 5,000 and 1,000 triangles.
SceneFacts scene(std::vector<ToolFacts> tools = {}) {
  return {kSphere.center_mm,
          {{1.0 / 3.0, 10000, cube(25.0)}, {2.0 / 3.0, 5000, cube(15.0)}, {1.0, 1000, cube(5.0)}},
          std::move(tools)};
}

/// The view is along +y: a tool of 100 triangles behind the inner shell, before the back of others.
SceneFacts scene_with_tool() { return scene({{100, cube(3.0, {0, 10, 0})}}); }

Plan plan_of(const SceneFacts& facts, const RenderOptions& options = {},
             const CameraOptions& camera = {}) {
  return make_plan(facts, make_camera(camera, kSphere), options);
}

const Pass* pass_of(const Plan& plan, PassKind kind) {
  const auto found = std::find_if(plan.passes.begin(), plan.passes.end(),
                                  [kind](const Pass& pass) { return pass.kind == kind; });
  return found == plan.passes.end() ? nullptr : &*found;
}

std::string why(const Plan& plan, const std::string& what) {
  const auto found = std::find_if(plan.left_out.begin(), plan.left_out.end(),
                                  [&](const LeftOut& item) { return item.what == what; });
  return found == plan.left_out.end() ? "" : found->why;
}

TEST(PlanModes, ACueIsTheDepthRangeOfEachShell) {
  const DepthCue cue{.a = 0.5, .b = 0.25, .beta0 = 0.25};  // 0.5 at the far end, 1 at the near one
  const Plan plan = plan_of(scene(), {.cue = cue});
  EXPECT_EQ(plan.depth_scale, 1.0);
  for (const ShellDraw& draw : pass_of(plan, PassKind::MaxDepth)->draws) {
    const double representative = (draw.shell + 1) / 3.0;
    EXPECT_DOUBLE_EQ(draw.depth_at_near, representative);
    EXPECT_DOUBLE_EQ(draw.depth_at_far, 0.5 * representative);
    EXPECT_EQ(draw.faces, Faces::Front);
  }
  EXPECT_EQ(why(plan, "depth cue"), "");
}

TEST(PlanModes, ACueThatFallsTowardsTheEyeTakesBackFaces) {
  const Plan plan = plan_of(scene(), {.cue = {.a = -1.0, .b = 2.0}});
  EXPECT_EQ(plan.depth_scale, 2.0);
  for (const ShellDraw& draw : pass_of(plan, PassKind::MaxDepth)->draws) {
    EXPECT_EQ(draw.faces, Faces::Back);
    EXPECT_LT(draw.depth_at_near, draw.depth_at_far);
  }
}

TEST(PlanModes, SumsWeighWhatAShellAddsToTheOneAround) {
  const Plan plan = plan_of(scene(), {.mode = PictureMode::Sum, .hidden = {1}});
  const std::vector<ShellDraw>& draws = pass_of(plan, PassKind::Sum)->draws;
  ASSERT_EQ(draws.size(), 2U);
  EXPECT_DOUBLE_EQ(draws[0].weight, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(draws[1].weight, 2.0 / 3.0);
  for (const ShellDraw& draw : draws) EXPECT_EQ(draw.faces, Faces::Both);
  EXPECT_EQ(shells_drawn(plan), (std::vector<std::uint32_t>{0, 2}));
}

TEST(PlanModes, CountsWeighWhatAShellShows) {
  const Plan plan = plan_of(scene(), {.mode = PictureMode::Count});
  EXPECT_DOUBLE_EQ(pass_of(plan, PassKind::Count)->draws.at(1).weight, 2.0 / 3.0);
}

TEST(PlanModes, TheOutermostLitShellHidesTheOthers) {
  const Plan plan = plan_of(scene(), {.mode = PictureMode::Iso});
  EXPECT_EQ(shells_drawn(plan), std::vector<std::uint32_t>{0});
  EXPECT_TRUE(plan.normals);
  EXPECT_EQ(why(plan, "shells 2-3 (6000 triangles)"),
            "enclosed: the outermost shell shown hides them");
  EXPECT_EQ(shells_drawn(plan_of(scene(), {.mode = PictureMode::Iso, .hidden = {0}})),
            std::vector<std::uint32_t>{1});
  // A slab that cuts it open shows what is inside.
  const Plan open = plan_of(scene(), {.mode = PictureMode::Iso, .slab = {.near_mm = 0.0}});
  EXPECT_EQ(shells_drawn(open).size(), 3U);
}

TEST(PlanModes, ShellsOutsideTheSlabAreLeftOut) {
  const Plan plan = plan_of(scene(), {.slab = {.far_mm = -6.0}});
  EXPECT_EQ(shells_drawn(plan), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(why(plan, "shell 3 (1000 triangles)"), "outside the slab");
}

TEST(PlanModes, ASlabBehindAPerspectiveEyeShowsNothing) {
  const CameraOptions inside{.field_of_view_rad = 0.7, .distance_mm = 0.0};
  EXPECT_TRUE(plan_of(scene(), {.slab = {.far_mm = -1.0}}, inside).passes.empty());
}

TEST(PlanModes, ToolsCutTheShellsTheyReachOnly) {
  // Behind the two inner shells.
  const Plan plan = plan_of(scene({{100, cube(2.0, {0, 20, 0})}}));
  ASSERT_NE(pass_of(plan, PassKind::ToolLayer), nullptr);
  for (const ShellDraw& draw : pass_of(plan, PassKind::MaxDepth)->draws) {
    EXPECT_EQ(draw.tools, draw.shell == 0 ? ToolCut::Texture : ToolCut::None);
  }
  EXPECT_EQ(why(plan, "tools against shells 2-3 (6000 triangles)"), "no tool reaches their bounds");
}

TEST(PlanModes, ToolsOutOfViewAreLeftOut) {
  const Plan plan = plan_of(scene({{100, cube(2.0, {500, 0, 0})}}));
  EXPECT_EQ(pass_of(plan, PassKind::ToolLayer), nullptr);
  EXPECT_EQ(why(plan, "tool 1 (100 triangles)"), "outside the view");
  EXPECT_EQ(why(plan, "tool colour"), "no tool is in view");
}

TEST(PlanModes, PassesDrawToolsBeforeShellsDimmestFirst) {
  const Plan plan = plan_of(scene_with_tool(), {.occlusion = Occlusion::Passes});
  const Pass* pass = pass_of(plan, PassKind::MaxColor);
  ASSERT_NE(pass, nullptr);
  EXPECT_EQ(pass->draws.front().shell, 0U);
  EXPECT_EQ(pass->draws[1].tools, ToolCut::Passes);
  EXPECT_DOUBLE_EQ(pass->draws[1].depth_at_near, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(pass->draws[1].depth_at_far, 1.0 / 3.0);
  // The tool is behind the innermost shell: before two shells it is drawn.
  EXPECT_EQ(triangles(*pass), 16000U + 200U);
  EXPECT_EQ(why(plan, "colour target"), "");
}

TEST(PlanModes, PassesThatWouldNotBeExactGiveWayToTheTexture) {
  for (const DepthCue& cue : {DepthCue{.a = -0.5, .b = 1.0}, DepthCue{.a = 1e-4, .b = 1.0}}) {
    const Plan plan = plan_of(scene_with_tool(), {.cue = cue, .occlusion = Occlusion::Passes});
    EXPECT_NE(pass_of(plan, PassKind::MaxDepth), nullptr);
    EXPECT_NE(why(plan, "occlusion by passes"), "");
  }
}

TEST(PlanModes, AutoTakesTheTexture) {
  EXPECT_EQ(pass_of(plan_of(scene_with_tool()), PassKind::MaxColor), nullptr);
  const Plan plan = plan_of(scene_with_tool(), {.occlusion = Occlusion::Texture});
  EXPECT_EQ(describe(plan.passes.back()), describe(plan_of(scene_with_tool()).passes.back()));
}

TEST(PlanModes, CountsAreMadeWhereRaysStartInsideAndToolsEndThem) {
  const CameraOptions inside{.field_of_view_rad = 0.7, .distance_mm = 10.0};
  // Without a tool back faces do.
  EXPECT_EQ(pass_of(plan_of(scene(), {}, inside), PassKind::StartCounts), nullptr);
  const Plan plan = plan_of(scene_with_tool(), {}, inside);
  const Pass* starts = pass_of(plan, PassKind::StartCounts);
  ASSERT_NE(starts, nullptr);
  EXPECT_EQ(starts->draws.size(), 2U);
  EXPECT_EQ(starts->emission_of_count, (std::vector<float>{0.0F, 1.0F / 3.0F, 2.0F / 3.0F}));
  EXPECT_EQ(pass_of(plan, PassKind::EndCounts), nullptr);
  // A cue that rises towards the eye is brightest where rays start.
  const RenderOptions rising{.cue = {.a = 0.5, .b = 0.5}};
  EXPECT_NE(pass_of(plan_of(scene(), rising, inside), PassKind::StartCounts), nullptr);
}

TEST(PlanModes, EndsAreCountedUnderACueThatFallsTowardsTheEye) {
  const RenderOptions falling{.cue = {.a = -0.5, .b = 1.0}};
  EXPECT_EQ(pass_of(plan_of(scene(), falling), PassKind::EndCounts), nullptr);
  const Plan plan = plan_of(scene_with_tool(), falling);
  ASSERT_NE(pass_of(plan, PassKind::EndCounts), nullptr);
  EXPECT_EQ(pass_of(plan, PassKind::StartCounts), nullptr);
  EXPECT_NE(
      pass_of(plan_of(scene(), {.cue = falling.cue, .slab = {.far_mm = 3.0}}), PassKind::EndCounts),
      nullptr);
}

TEST(PlanModes, RaysAreMeasuredFromTheNearestOfWhatIsDrawn) {
  EXPECT_DOUBLE_EQ(plan_of(scene()).rays.start_mm, -25.0);
  EXPECT_DOUBLE_EQ(plan_of(scene(), {.slab = {.near_mm = -7.0}}).rays.start_mm, -7.0);
  const Plan seen = plan_of(scene(), {}, {.field_of_view_rad = 0.7, .distance_mm = 100.0});
  EXPECT_DOUBLE_EQ(seen.rays.start_mm, 75.0);
}

TEST(PlanModes, PassesAreDescribed) {
  const Plan plan = plan_of(scene_with_tool(), {.mode = PictureMode::Sum});
  ASSERT_EQ(plan.passes.size(), 2U);
  EXPECT_EQ(describe(plan.passes[0]), "tools: colour and depth: 1 tool, 100 triangles");
  EXPECT_EQ(describe(plan.passes[1]),
            "sum of signed crossings: 3 shells, 2 compared with the tools' depth, 16000 triangles");
}

}  // namespace
}  // namespace nacre

// What the plan leaves out: the picture is the same, and the work is gone.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/error.h"
#include "tests/render/gl_test_support.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {
namespace {

const BoundingSphere kSphere{{0.0, 0.0, 0.0}, 60.0};

/// What a picture took.
struct Cost {
  Picture picture;
  FrameStats frame;
  std::size_t uploaded_bytes = 0;
};

/// A picture drawn with no more uploaded than its plan asks for.
class GlSavings : public GlTest {
 protected:
  static Cost cost(const ShellSet& set, std::span<const Tool> tools, const Camera& camera,
                   const RenderOptions& options) {
    const SceneFacts facts = scene_facts(set, tools);
    const Plan plan = make_plan(facts, camera, options, renderer().capabilities());
    renderer().upload(set, facts, shells_drawn(plan), {.normals = plan.normals});
    renderer().upload_tools(tools);
    Cost cost{renderer().render(camera, plan), renderer().last_frame(),
              renderer().uploaded_bytes()};
    return cost;
  }

  /// Draws with a rule and without; the pictures are the same to `tolerance`.
  static std::pair<Cost, Cost> with_and_without(const ShellSet& set, std::span<const Tool> tools,
                                                const Camera& camera, RenderOptions options,
                                                const PlanRules& without, float tolerance = 0.0F) {
    Cost with = cost(set, tools, camera, options);
    options.rules = without;
    Cost all = cost(set, tools, camera, options);
    const std::vector<float>& a = with.picture.volume.pixels;
    const std::vector<float>& b = all.picture.volume.pixels;
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (std::abs(a[i] - b[i]) > tolerance) ++differing;
    }
    EXPECT_EQ(differing, 0U);
    return {std::move(with), std::move(all)};
  }
};

const ShellSet& balls() {
  static const ShellSet set = nested_balls(4, 40.0, 12);
  return set;
}

Tool block_tool(const glm::dvec3& lo, const glm::dvec3& hi) {
  Tool tool;
  tool.mesh = block_mesh(lo, hi);
  return tool;
}

Camera plain_camera() { return make_camera({.size = {48, 48}, .azimuth_rad = 0.2}, kSphere); }

Camera camera_inside() {
  return make_camera(
      {.size = {48, 48}, .azimuth_rad = 0.2, .field_of_view_rad = 1.2, .distance_mm = 24.0},
      kSphere);
}

constexpr std::array<PictureMode, 4> kModes{PictureMode::Max, PictureMode::Sum, PictureMode::Count,
                                            PictureMode::Iso};

// Shells within 20 mm of the centre lie behind the slab, on both sides of the others.
TEST_F(GlSavings, ShellsOutsideTheSlabShowNothing) {
  for (const PictureMode mode : kModes) {
    for (const Slab& slab : {Slab{.far_mm = -25.0}, Slab{.near_mm = 21.0}}) {
      const auto [with, without] =
          with_and_without(balls(), {}, plain_camera(), {.mode = mode, .slab = slab},
                           {.leave_out_outside_slab = false}, 1e-4F);
      if (mode == PictureMode::Iso && slab.far_mm < 0.0) continue;  // the outer shell hides them
      EXPECT_LT(with.frame.triangles, without.frame.triangles);
      EXPECT_LT(with.uploaded_bytes, without.uploaded_bytes);
    }
  }
}

TEST_F(GlSavings, ShellsThatAddNothingToASumAreNotDrawn) {
  ShellSet set = balls();
  set.shells[2].representative = set.shells[1].representative;
  const auto [with, without] = with_and_without(set, {}, plain_camera(), {.mode = PictureMode::Sum},
                                                {.leave_out_dark = false}, 1e-4F);
  EXPECT_LT(with.frame.triangles, without.frame.triangles);
  EXPECT_LT(with.uploaded_bytes, without.uploaded_bytes);
}

TEST_F(GlSavings, EnclosedShellsAreNotLit) {
  const auto [with, without] = with_and_without(
      balls(), {}, plain_camera(), {.mode = PictureMode::Iso}, {.leave_out_enclosed = false});
  EXPECT_EQ(with.frame.draws, 1U);
  EXPECT_EQ(without.frame.draws, 4U);
  EXPECT_LT(with.uploaded_bytes, without.uploaded_bytes);
}

TEST_F(GlSavings, FrontsOfLitShellsSuffice) {
  with_and_without(balls(), {}, plain_camera(), {.mode = PictureMode::Iso}, {.cull_faces = false});
}

// The ends of rays are looked at where they can matter, whichever walls are drawn.
TEST_F(GlSavings, OneWallSufficesUnderACue) {
  for (const Camera& camera : {plain_camera(), camera_inside()}) {
    for (const double a : {0.8, -0.8}) {
      const DepthCue cue{.a = a, .b = a > 0.0 ? 0.2 : 1.0};
      const std::vector<Tool> tools{block_tool({-60, -5, -9}, {60, 10, 4})};
      with_and_without(balls(), tools, camera, {.cue = cue}, {.cull_faces = false}, 1e-6F);
      with_and_without(balls(), {}, camera, {.cue = cue, .slab = {-12.0, 13.0}},
                       {.cull_faces = false}, 1e-6F);
    }
  }
}

TEST_F(GlSavings, AFlatCueIsOneFactor) {
  const DepthCue half{.a = 0.0, .b = 0.5};
  for (const Camera& camera : {plain_camera(), camera_inside()}) {
    with_and_without(balls(), {}, camera, {.cue = half}, {.leave_out_flat_cue = false}, 1e-6F);
  }
  // Without a cue there is nothing to round: the pictures are the same bit for bit.
  EXPECT_EQ(pixels_that_differ(draw(balls(), plain_camera()),
                               draw(balls(), plain_camera(), {.cue = {0.0, 1.0, 0.0}})),
            0U);
}

TEST_F(GlSavings, ToolsOutsideTheViewAreNotDrawn) {
  const std::vector<Tool> tools{block_tool({200, -5, -5}, {210, 5, 5})};
  const auto [with, without] =
      with_and_without(balls(), tools, plain_camera(), {}, {.leave_out_outside_view = false});
  EXPECT_EQ(with.frame.passes, 1U);
  EXPECT_EQ(without.frame.passes, 2U);
  EXPECT_LT(with.frame.triangles, without.frame.triangles);
  EXPECT_LT(with.frame.target_bytes, without.frame.target_bytes);
  EXPECT_FALSE(with.picture.tools.has_value());
}

// Behind the inner two shells and beside the others: only the outer shells can be hidden by it.
TEST_F(GlSavings, ToolsAreNotDrawnForShellsTheyDoNotReach) {
  const std::vector<Tool> tools{block_tool({-6, 23, -6}, {6, 60, 6})};
  for (const PictureMode mode : kModes) {
    for (const Camera& camera :
         {plain_camera(), make_camera({.size = {48, 48}, .field_of_view_rad = 0.6}, kSphere)}) {
      const RenderOptions options{.mode = mode, .occlusion = Occlusion::Passes};
      const auto [with, without] =
          with_and_without(balls(), tools, camera, options, {.limit_occlusion = false}, 1e-4F);
      if (mode == PictureMode::Max) {
        EXPECT_LT(with.frame.triangles, without.frame.triangles);
      }
    }
  }
}

TEST_F(GlSavings, StartsAreCountedOnlyWhereRaysStartInside) {
  const std::vector<Tool> tools{block_tool({-60, -5, -9}, {60, 10, 4})};
  const PlanRules always{.leave_out_start_counts = false};
  for (const double a : {0.0, 0.8, -0.8}) {
    const RenderOptions options{.cue = {.a = a, .b = a < 0.0 ? 1.0 : 0.2}};
    const auto [with, without] = with_and_without(balls(), tools, plain_camera(), options, always);
    EXPECT_LT(with.frame.passes, without.frame.passes);
    EXPECT_LT(with.frame.target_bytes, without.frame.target_bytes);
    with_and_without(balls(), tools, camera_inside(), options, always);
    with_and_without(balls(), {}, camera_inside(), options, always);
  }
}

TEST_F(GlSavings, EndsAreCountedOnlyWhereTheyAreBrighter) {
  const std::vector<Tool> tools{block_tool({-60, -5, -9}, {60, 10, 4})};
  const PlanRules always{.leave_out_end_counts = false};
  for (const double a : {0.0, 0.8}) {
    const RenderOptions options{.cue = {.a = a, .b = 0.2}};
    const auto [with, without] = with_and_without(balls(), tools, plain_camera(), options, always);
    EXPECT_LT(with.frame.passes, without.frame.passes);
  }
  const RenderOptions falling{.cue = {.a = -0.8, .b = 1.0}};
  const auto [with, without] = with_and_without(balls(), {}, plain_camera(), falling, always);
  EXPECT_LT(with.frame.passes, without.frame.passes);
  with_and_without(balls(), tools, plain_camera(), falling, always);
}

TEST_F(GlSavings, TheDepthIsThePictureOfAMaximum) {
  for (const double a : {0.0, 0.8, -0.8}) {
    const RenderOptions options{.cue = {.a = a, .b = a < 0.0 ? 1.0 : 0.2}};
    const auto [with, without] =
        with_and_without(balls(), {}, plain_camera(), options, {.leave_out_color = false}, 1e-6F);
    EXPECT_LT(with.frame.target_bytes, without.frame.target_bytes);
  }
}

TEST_F(GlSavings, NormalsAreUploadedForLitShellsOnly) {
  for (const PictureMode mode : {PictureMode::Max, PictureMode::Sum, PictureMode::Count}) {
    const auto [with, without] =
        with_and_without(balls(), {}, plain_camera(), {.mode = mode}, {.leave_out_normals = false});
    EXPECT_LT(with.uploaded_bytes, without.uploaded_bytes);
  }
}

TEST_F(GlSavings, APictureWithoutToolsKnowsNothingOfThem) {
  const Cost plain = cost(balls(), {}, plain_camera(), {});
  EXPECT_EQ(plain.frame.passes, 1U);
  EXPECT_EQ(plain.frame.target_bytes, 48U * 48U * 4U);
  EXPECT_FALSE(plain.picture.tools.has_value());
}

TEST_F(GlSavings, LitShellsWithoutNormalsAreRefused) {
  renderer().upload(balls());
  EXPECT_THROW(renderer().render(plain_camera(), RenderOptions{.mode = PictureMode::Iso}), Error);
}

TEST_F(GlSavings, ToolsThatWereNotUploadedAreRefused) {
  const std::vector<Tool> tools{block_tool({-6, -6, -6}, {6, 6, 6})};
  const Plan plan = make_plan(scene_facts(balls(), tools), plain_camera(), {});
  renderer().upload(balls());
  EXPECT_THROW(renderer().render(plain_camera(), plan), Error);
}

}  // namespace
}  // namespace nacre::testing

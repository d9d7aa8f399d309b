#include <gtest/gtest.h>

#include "tests/render/gl_test_support.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {
namespace {

const BoundingSphere kSphere{{0.0, 0.0, 0.0}, 60.0};

class GlRules : public GlTest {
 protected:
  /// Draws with and without a rule: the picture is the same, the work is not.
  static void expect_same_picture_for_less(const ShellSet& set, const Camera& camera,
                                           const PlanRules& without) {
    const Image with_rule = draw(set, camera);
    const FrameStats less = renderer().last_frame();
    const Image without_rule = draw(set, camera, {.rules = without});
    const FrameStats more = renderer().last_frame();
    EXPECT_EQ(pixels_that_differ(with_rule, without_rule), 0U);
    EXPECT_LT(less.draws, more.draws);
  }
};

TEST_F(GlRules, EmptyShellsShowNothing) {
  ShellSet set = nested_balls(4, 40.0, 8);
  set.shells[2].surface = {};
  expect_same_picture_for_less(set, make_camera({.size = {48, 48}}, kSphere),
                               {.leave_out_empty = false});
}

TEST_F(GlRules, DarkShellsShowNothing) {
  ShellSet set = nested_balls(4, 40.0, 8);
  set.shells[0].representative = 0.0;
  expect_same_picture_for_less(set, make_camera({.size = {48, 48}}, kSphere),
                               {.leave_out_dark = false});
}

TEST_F(GlRules, ShellsOutsideTheViewShowNothing) {
  const ShellSet set = nested_balls(6, 40.0, 12);
  for (const std::optional<double> field_of_view : {std::optional<double>(), {0.7}}) {
    expect_same_picture_for_less(set,
                                 make_camera({.size = {48, 48},
                                              .zoom = 8.0,
                                              .field_of_view_rad = field_of_view,
                                              .look_at_mm = glm::dvec3(30, 0, 0)},
                                             kSphere),
                                 {.leave_out_outside_view = false});
  }
}

// One wall of each shell shows what both do, the eye outside and inside.
TEST_F(GlRules, OneWallOfAShellSuffices) {
  const ShellSet set = make_set({ball_mesh({}, 40.0, 12), ring_mesh({}, 25.0, 8.0, 20),
                                 block_mesh({-10, -5, -5}, {20, 5, 10})});
  for (const double distance_mm : {0.0, 10.0, 26.0, 45.0, 200.0}) {
    const Camera camera = make_camera({.size = {64, 64},
                                       .azimuth_rad = 0.4,
                                       .field_of_view_rad = 1.5,
                                       .distance_mm = distance_mm},
                                      kSphere);
    const Image one = draw(set, camera);
    const Image both = draw(set, camera, {.rules = {.cull_faces = false}});
    EXPECT_EQ(pixels_that_differ(one, both), 0U) << distance_mm << " mm";
  }
  const Camera camera = make_camera({.size = {64, 64}, .azimuth_rad = 0.4}, kSphere);
  EXPECT_EQ(
      pixels_that_differ(draw(set, camera), draw(set, camera, {.rules = {.cull_faces = false}})),
      0U);
}

// The plan names the shells it needs; with those alone uploaded the picture is the same.
TEST_F(GlRules, UploadsOnlyWhatIsDrawn) {
  ShellSet set = nested_balls(4, 40.0, 8);
  const SceneFacts facts = scene_facts(set);
  const Camera camera = make_camera({.size = {48, 48}}, kSphere);
  const RenderOptions options{.hidden = {1, 2}};
  const Image image = draw(set, camera, options);
  const std::size_t all_bytes = renderer().uploaded_bytes();

  const Plan plan = make_plan(facts, camera, options, renderer().capabilities());
  set.shells[1].surface = {};  // as if never decoded
  set.shells[2].surface = {};
  renderer().upload(set, facts, shells_drawn(plan));
  EXPECT_EQ(pixels_that_differ(image, renderer().render(camera, plan).volume), 0U);
  EXPECT_EQ(2 * renderer().uploaded_bytes(), all_bytes);
}

}  // namespace
}  // namespace nacre::testing

// What tools and slabs leave of a maximum on the processor, against OpenGL, closed forms and
// itself.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "core/error.h"
#include "core/picture.h"
#include "render/cpu/cpu_renderer.h"
#include "tests/render/both_renderers.h"
#include "tests/render/cpu_test_support.h"
#include "tests/render/gl_test_support.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {
namespace {

/// Pixels in which pictures differ by more than rounding, in all that was compared.
struct Difference {
  std::size_t pixels = 0;
  std::size_t volume = 0;
  std::size_t covered = 0;
  std::size_t colors = 0;

  void add(const Picture& a, const Picture& b) {
    pixels += a.volume.pixels.size();
    for (std::size_t i = 0; i < a.volume.pixels.size(); ++i) {
      if (!(std::abs(a.volume.pixels[i] - b.volume.pixels[i]) <= 1e-3F)) ++volume;
    }
    ASSERT_EQ(a.tools.has_value(), b.tools.has_value());
    if (!a.tools) return;
    for (std::size_t i = 0; i < a.tools->covered.size(); ++i) {
      if (a.tools->covered[i] != b.tools->covered[i]) ++covered;
      const glm::vec3 off = glm::abs(a.tools->colors[i] - b.tools->colors[i]);
      if (!(std::max({off.x, off.y, off.z}) <= 1e-3F)) ++colors;
    }
  }

  void expect_rare() const {
    EXPECT_LE(volume, pixels / 10000) << pixels;
    EXPECT_LE(covered, pixels / 10000) << pixels;
    EXPECT_LE(colors, pixels / 10000) << pixels;
  }
};

class CpuCuts : public BothRenderers {
 protected:
  void compare(const Camera& camera, const RenderOptions& options, Difference& difference,
               int tile_side = 4096) {
    const auto [ours, theirs] = draw_both(camera, options, tile_side);
    difference.add(ours, theirs);
  }
};

// Beside a vessel, a tool's pixels are not tinged by what lies behind the tool.
TEST_F(CpuCuts, SmoothLayersLeaveTheToolsBackgroundAlone) {
  std::size_t changed = 0;
  std::size_t black = 0;
  for (const Camera& camera : cameras(scan_.sphere, {160, 120})) {
    for (const std::vector<Tool>& tools : tools_about(scan_.sphere, camera)) {
      set_tools(tools);
      const Picture before = draw_both(camera, {}, 4096).first;
      for (const Layers layers : {Layers::Smooth, Layers::Fine}) {
        const auto [ours, theirs] = draw_both(camera, {.layers = layers}, 4096);
        const int samples = layers == Layers::Fine ? 3 : 1;
        const Image flat = middle_samples(
            draw_both(with_samples(camera, samples), {}, 4096).first.volume, samples);
        Difference difference;
        difference.add(ours, theirs);
        EXPECT_LE(difference.volume, difference.pixels / 1000);
        EXPECT_EQ(ours.tools.has_value(), before.tools.has_value());
        if (!ours.tools) continue;
        EXPECT_EQ(ours.tools->covered, before.tools->covered);
        for (std::size_t i = 0; i < ours.volume.pixels.size(); ++i) {
          const bool tool_alone = ours.tools->covered[i] != 0 && flat.pixels[i] == 0.0F;
          if (tool_alone) {
            EXPECT_EQ(ours.volume.pixels[i], 0.0F);
            ++black;
          }
          if (ours.volume.pixels[i] != flat.pixels[i]) ++changed;
        }
      }
    }
  }
  EXPECT_GT(black, 100U);
  EXPECT_GT(changed, 100U);
}

TEST_F(CpuCuts, SlabsCutWhatOpenGlCuts) {
  set_tools({});
  for (const DepthCue& cue : kCues) {
    for (const Slab& slab : slabs(scan_.sphere.radius_mm)) {
      Difference difference;
      for (const Camera& camera : cameras(scan_.sphere, {120, 120})) {
        compare(camera, {.cue = cue, .slab = slab}, difference);
      }
      difference.expect_rare();
    }
  }
}

TEST_F(CpuCuts, ToolsCutWhatOpenGlCutsAndLookTheSame) {
  for (const Camera& camera : cameras(scan_.sphere, {120, 120})) {
    for (const std::vector<Tool>& tools : tools_about(scan_.sphere, camera)) {
      set_tools(tools);
      Difference difference;
      for (const DepthCue& cue : kCues) compare(camera, {.cue = cue}, difference);
      difference.expect_rare();
    }
  }
}

TEST_F(CpuCuts, ToolsInSlabsCutWhatOpenGlCuts) {
  for (const Camera& camera : cameras(scan_.sphere, {120, 120})) {
    set_tools(tools_about(scan_.sphere, camera).back());
    Difference difference;
    for (const DepthCue& cue : kCues) {
      for (const Slab& slab : slabs(scan_.sphere.radius_mm)) {
        compare(camera, {.cue = cue, .slab = slab}, difference);
      }
    }
    difference.expect_rare();
  }
}

TEST_F(CpuCuts, TilesJoinToThePicture) {
  for (const Camera& camera : cameras(scan_.sphere, {120, 90})) {
    set_tools(tools_about(scan_.sphere, camera).back());
    Difference difference;
    compare(camera, {.cue = {0.8, 0.2}, .slab = {.far_mm = 0.2 * scan_.sphere.radius_mm}},
            difference, 50);
    difference.expect_rare();
  }
}

// A ball about the middle: where rays start inside it, at its centre, it shows; where they end
// before it, it does not.
TEST(CpuCutsAlone, ASlabShowsWhatLiesInIt) {
  const ShellSet set = nested_balls(2, 40.0, 16);  // radii 40 and 20
  const BoundingSphere sphere{{}, 60.0};
  const Camera camera = make_camera({.size = {33, 33}}, sphere);
  const auto middle = [&](const Slab& slab, const DepthCue& cue = {}) {
    return draw(set, {}, camera, {.cue = cue, .slab = slab}).volume.at(16, 16);
  };
  EXPECT_EQ(middle({.far_mm = -41.0}), 0.0F);
  EXPECT_EQ(middle({.far_mm = -30.0}), 0.5F);
  EXPECT_EQ(middle({.near_mm = -5.0, .far_mm = 5.0}), 1.0F);
  EXPECT_EQ(middle({.near_mm = 25.0}), 0.5F);
  EXPECT_EQ(middle({.near_mm = 41.0}), 0.0F);
  // z = (60 - d) / 120: the cue's brightest end of the slab, wholly within both balls.
  EXPECT_NEAR(middle({.near_mm = -6.0, .far_mm = 6.0}, {.a = 1.0, .b = 0.0}), 0.55F, 1e-6F);
  EXPECT_NEAR(middle({.near_mm = -6.0, .far_mm = 6.0}, {.a = -1.0, .b = 1.0}), 0.55F, 1e-6F);
}

// Its light falls with the cosine; its depth takes the cue; what is behind it does not show.
TEST(CpuCutsAlone, AToolIsLitAndHidesWhatIsBehind) {
  const ShellSet set = nested_balls(2, 40.0, 16);
  const BoundingSphere sphere{{}, 60.0};
  const Camera camera = make_camera({.size = {65, 65}}, sphere);
  const Tool ball = tool_of(ball_mesh({}, 5.0, 200), camera.forward * -30.0, {0.5F, 1.0F, 0.25F});
  const Picture picture = draw(set, {&ball, 1}, camera, {.cue = {.a = 1.0, .b = 0.0}});
  ASSERT_TRUE(picture.tools);
  const double pixel_mm = 120.0 / 65.0;
  for (const int x : {32, 33, 34}) {
    const double aside = pixel_mm * (x - 32);
    const double cosine = std::sqrt(1.0 - aside * aside / 25.0);
    const double z = (60.0 + 30.0 + 5.0 * cosine) / 120.0;
    const std::size_t at = static_cast<std::size_t>(x + 65 * 32);
    EXPECT_EQ(picture.tools->covered[at], 1);
    EXPECT_NEAR(picture.tools->colors[at].y, headlight(cosine) * z, 0.01);
    EXPECT_NEAR(picture.tools->colors[at].x, 0.5 * headlight(cosine) * z, 0.01);
    // Only the outer ball's front lies before it, 40 mm from the middle: half of z = 5 / 6.
    EXPECT_NEAR(picture.volume.pixels[at], 0.5 * 100.0 / 120.0, 0.002);
  }
  EXPECT_EQ(picture.tools->covered[36 + 65 * 32], 0);
}

TEST(CpuCutsAlone, ToolsBehindTheEyeAreNotSeen) {
  const ShellSet set = nested_balls(2, 40.0, 16);
  const BoundingSphere sphere{{}, 60.0};
  const Camera camera =
      make_camera({.size = {32, 32}, .field_of_view_rad = 1.0, .distance_mm = 100.0}, sphere);
  const Tool ball = tool_of(ball_mesh({}, 5.0, 20), camera.forward * -120.0, {1.0F, 1.0F, 1.0F});
  const Picture picture = draw(set, {&ball, 1}, camera, {});
  EXPECT_FALSE(picture.tools);
  EXPECT_EQ(picture.volume.pixels, draw(set, {}, camera, {}).volume.pixels);
}

TEST(CpuCutsAlone, RefuseToolsByPasses) {
  const ShellSet set = nested_balls(2, 40.0, 16);
  const BoundingSphere sphere{{}, 60.0};
  const Camera camera = make_camera({.size = {16, 16}}, sphere);
  const Tool ball = tool_of(ball_mesh({}, 5.0, 8), {}, {1.0F, 1.0F, 1.0F});
  EXPECT_THROW(draw(set, {&ball, 1}, camera, {.occlusion = Occlusion::Passes}), Error);
  EXPECT_NO_THROW(draw(set, {&ball, 1}, camera, {.occlusion = Occlusion::Texture}));
}

TEST(CpuCutsAlone, AreTheSameForAllThreadsAndInstructions) {
  const Scan scan = small_angiogram();
  for (const Camera& camera : cameras(scan.sphere, {120, 90})) {
    const std::vector<Tool> tools = tools_about(scan.sphere, camera).back();
    for (const DepthCue& cue : kCues) {
      const RenderOptions options{.cue = cue, .slab = slabs(scan.sphere.radius_mm).back()};
      const Picture expected = draw(scan.set, tools, camera, options);
      for (const std::size_t threads : {1U, 2U, 5U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        for (const InstructionSet set : instruction_sets()) {
          const Picture picture = draw(scan.set, tools, camera, options, {.instructions = set});
          EXPECT_EQ(picture.volume.pixels, expected.volume.pixels) << threads;
          ASSERT_EQ(picture.tools.has_value(), expected.tools.has_value());
          if (!expected.tools) continue;
          EXPECT_EQ(picture.tools->colors, expected.tools->colors) << threads;
          EXPECT_EQ(picture.tools->covered, expected.tools->covered) << threads;
        }
      }
    }
  }
}

}  // namespace
}  // namespace nacre::testing

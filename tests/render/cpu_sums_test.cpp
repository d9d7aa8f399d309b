// Sums and counts on the processor, against OpenGL, rays, closed forms and itself.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/error.h"
#include "core/picture.h"
#include "reference/shell_picture.h"
#include "render/cpu/cpu_renderer.h"
#include "tests/render/both_renderers.h"
#include "tests/render/cpu_test_support.h"
#include "tests/render/gl_test_support.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {
namespace {

const std::array<PictureMode, 2> kModes{PictureMode::Sum, PictureMode::Count};

/// What pictures of crossings may differ by, besides where a crossing is missed: an integral by
/// the rounding of some dozen depths in floats, of a hundred mm each.
double tolerance_of(PictureMode mode) { return mode == PictureMode::Sum ? 1e-3 : 1e-5; }

/// Pixels that differ by more than the tolerance.
std::size_t far_off(const Image& a, const Image& b, double tolerance) {
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    if (!(std::abs(a.pixels[i] - b.pixels[i]) <= tolerance)) ++count;
  }
  return count;
}

/// Slabs, and none.
std::vector<Slab> slabs_and_none(double radius_mm) {
  std::vector<Slab> list = slabs(radius_mm);
  list.insert(list.begin(), Slab{});
  return list;
}

class CpuSums : public BothRenderers {
 protected:
  void compare(const Camera& camera, const RenderOptions& options, int tile_side = 4096) {
    const auto [picture, by_gl] = draw_both(camera, options, tile_side);
    const Image& ours = picture.volume;
    pixels_ += ours.pixels.size();
    lit_ += ours.pixels.size() -
            static_cast<std::size_t>(std::count(ours.pixels.begin(), ours.pixels.end(), 0.0F));
    off_ += far_off(ours, by_gl.volume, tolerance_of(options.mode));
  }

  /// At most 1 pixel in 10,000 of all that was compared is off.
  void expect_rare() const {
    EXPECT_LE(off_, pixels_ / 10000) << pixels_;
    EXPECT_GT(lit_, pixels_ / 100) << pixels_;
  }

  std::size_t pixels_ = 0;
  std::size_t lit_ = 0;
  std::size_t off_ = 0;
};

TEST_F(CpuSums, AreOpenGlsInSlabsUnderCues) {
  set_tools({});
  for (const PictureMode mode : kModes) {
    for (const Camera& camera : cameras(scan_.sphere, {120, 120})) {
      for (const DepthCue& cue : kCues) {
        for (const Slab& slab : slabs_and_none(scan_.sphere.radius_mm)) {
          compare(camera, {.mode = mode, .cue = cue, .slab = slab});
        }
      }
    }
  }
  expect_rare();
}

TEST_F(CpuSums, AreOpenGlsBehindTools) {
  for (const Camera& camera : cameras(scan_.sphere, {120, 120})) {
    for (const std::vector<Tool>& tools : tools_about(scan_.sphere, camera)) {
      set_tools(tools);
      for (const PictureMode mode : kModes) {
        for (const DepthCue& cue : kCues) {
          for (const Slab& slab : {Slab{}, slabs(scan_.sphere.radius_mm).back()}) {
            compare(camera, {.mode = mode, .cue = cue, .slab = slab});
          }
        }
      }
    }
  }
  expect_rare();
}

// What the plan asks for by passes is drawn by texture, as OpenGL does.
TEST_F(CpuSums, AreOpenGlsWhateverTheWayOfTools) {
  const Camera camera = cameras(scan_.sphere, {120, 120}).front();
  set_tools(tools_about(scan_.sphere, camera).back());
  for (const Occlusion way : {Occlusion::Auto, Occlusion::Passes, Occlusion::Texture}) {
    for (const PictureMode mode : kModes) compare(camera, {.mode = mode, .occlusion = way});
  }
  expect_rare();
}

TEST_F(CpuSums, OfTilesJoinToThePicture) {
  for (const Camera& camera : cameras(scan_.sphere, {120, 90})) {
    set_tools(tools_about(scan_.sphere, camera).back());
    for (const PictureMode mode : kModes) {
      compare(camera, {.mode = mode, .cue = kCues[1], .slab = {.far_mm = 10.0}}, 50);
    }
  }
  expect_rare();
}

// Depth buffers and targets of OpenGL's are not here.
TEST(CpuSumsAlone, RefuseTargetsOfFewBits) {
  const ShellSet set = nested_balls(2, 40.0, 8);
  const Camera camera = make_camera({.size = {16, 16}}, {{}, 60.0});
  for (const PictureMode mode : kModes) {
    const RenderOptions halves{.mode = mode, .target = TargetFormat::F16};
    EXPECT_TRUE(cpu_objection(make_plan(scene_facts(set), camera, halves)));
    EXPECT_THROW(draw(set, {}, camera, halves), Error);
    EXPECT_FALSE(cpu_objection(make_plan(scene_facts(set), camera, {.mode = mode})));
  }
}

/// Expects what rays in double show of the very triangles, but for `most_off` of the pixels: at
/// silhouettes, where corners are rounded to 1/256 of a pixel.
void expect_rays(const ShellSet& set, std::span<const Tool> tools, const Camera& camera,
                 const RenderOptions& options, double most_off) {
  const ToolRays tool_rays(tools);
  const Image exact = shell_picture(set, camera,
                                    {.mode = options.mode,
                                     .cue = options.cue,
                                     .slab = options.slab,
                                     .tools = tools.empty() ? nullptr : &tool_rays})
                          .volume;
  const Image ours = draw(set, tools, camera, options).volume;
  // Beside an edge the ray may meet the next triangle; from within a shell, rays start at the near
  // plane, 0.0006 mm from the eye.
  const double tolerance = 10.0 * tolerance_of(options.mode);
  EXPECT_LE(static_cast<double>(far_off(ours, exact, tolerance)),
            most_off * static_cast<double>(exact.pixels.size()))
      << static_cast<int>(options.mode) << ", a = " << options.cue.a << ", slab from "
      << options.slab.near_mm << (camera.perspective ? ", perspective" : "");
}

TEST(CpuSumsAlone, AreWhatRaysShowOfTheSameTriangles) {
  const glm::dvec3 center(100.0, -200.0, 300.0);
  const BoundingSphere sphere{center, 60.0};
  const ShellSet set = mixed_set(center);
  for (const Camera& camera : cameras(sphere, {60, 60})) {
    const std::vector<Tool> tools = tools_about(sphere, camera).back();
    for (const PictureMode mode : kModes) {
      for (const DepthCue& cue : kCues) {
        for (const Slab& slab : slabs_and_none(60.0)) {
          expect_rays(set, {}, camera, {.mode = mode, .cue = cue, .slab = slab}, 0.002);
          expect_rays(set, tools, camera, {.mode = mode, .cue = cue, .slab = slab}, 0.002);
        }
      }
    }
  }
}

// Walls along the view, thinner in the picture than the rounding of their corners, reach through
// all the scene; rays start near its end, where the cue is darkest.
TEST(CpuSumsAlone, StayWithinTheSceneAtWallsAlongTheView) {
  const BoundingSphere sphere{{}, 60.0};
  const ShellSet set = make_set({block_mesh({-30, -58, -20}, {10, 58, 20})}, {});
  for (const double turn : {0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3}) {
    for (const auto field_of_view : {std::optional<double>(), std::optional<double>(0.1)}) {
      const Camera camera = make_camera(
          {.size = {60, 60}, .azimuth_rad = turn, .field_of_view_rad = field_of_view}, sphere);
      for (const DepthCue& cue : {DepthCue{-1.0, 1.0, 0.0}, DepthCue{1.0, 0.0, 0.0}, DepthCue{}}) {
        const RenderOptions options{
            .mode = PictureMode::Sum, .cue = cue, .slab = {.near_mm = 57.0}};
        const Image ours = draw(set, {}, camera, options).volume;
        for (const float pixel : ours.pixels) {
          ASSERT_GE(pixel, -0.01F) << turn;
          ASSERT_LE(pixel, 1.05F) << turn;  // mm from 57 to 58, and the corners
        }
        expect_rays(set, {}, camera, options, 0.02);  // the walls' own columns are lines
      }
    }
  }
}

// Triangles of many thousand pixels, most of them outside.
TEST(CpuSumsAlone, AreWhatRaysShowOfHugeTriangles) {
  const BoundingSphere sphere{{}, 60.0};
  const ShellSet set = mixed_set({});
  for (const auto field_of_view : {std::optional<double>(), std::optional<double>(0.7)}) {
    for (const double zoom : {3.5, 300.0, 1e5}) {
      const Camera camera = make_camera({.size = {48, 48},
                                         .elevation_rad = 0.6,
                                         .zoom = zoom,
                                         .field_of_view_rad = field_of_view,
                                         .look_at_mm = glm::dvec3(20, 5, 10)},
                                        sphere);
      for (const PictureMode mode : kModes) {
        for (const Slab& slab : slabs_and_none(60.0)) {
          expect_rays(set, {}, camera, {.mode = mode, .cue = kCues[1], .slab = slab}, 0.002);
        }
      }
    }
  }
}

// The eye between, inside and at the centre of shells; triangles cross its near plane.
TEST(CpuSumsAlone, AreWhatRaysShowFromInside) {
  const BoundingSphere sphere{{}, 60.0};
  const ShellSet set = mixed_set({});
  for (const double field_of_view : {0.7, 2.0, 2.9}) {
    for (const double distance : {0.0, 3.0, 24.0, 38.0, 55.0}) {
      const Camera camera = make_camera({.size = {40, 40},
                                         .azimuth_rad = 2.2,
                                         .elevation_rad = 0.2,
                                         .field_of_view_rad = field_of_view,
                                         .distance_mm = distance},
                                        sphere);
      for (const PictureMode mode : kModes) {
        for (const Slab& slab : {Slab{}, Slab{.near_mm = -10.0, .far_mm = 20.0}}) {
          expect_rays(set, {}, camera, {.mode = mode, .cue = kCues[2], .slab = slab}, 0.002);
        }
      }
    }
  }
}

// Chords of balls about the middle: 2 sqrt(r^2 - x^2), half of it each.
TEST(CpuSumsAlone, AddUpChords) {
  const ShellSet set = nested_balls(2, 40.0, 300);  // radii 40 and 20
  const BoundingSphere sphere{{}, 60.0};
  const Camera camera = make_camera({.size = {61, 61}}, sphere);
  const double pixel_mm = 120.0 / 61.0;
  const auto row = [&](const RenderOptions& options) { return draw(set, {}, camera, options); };
  const Image sums = row({.mode = PictureMode::Sum}).volume;
  const Image cued = row({.mode = PictureMode::Sum, .cue = {.a = 1.0, .b = 0.0}}).volume;
  const Image front = row({.mode = PictureMode::Sum, .slab = {.far_mm = 0.0}}).volume;
  const Image counts = row({.mode = PictureMode::Count}).volume;
  for (int x = 0; x < 61; ++x) {
    const double aside = std::abs(pixel_mm * (x - 30));
    const auto chord = [&](double radius) {
      return 2.0 * std::sqrt(std::max(radius * radius - aside * aside, 0.0));
    };
    if (std::abs(aside - 40.0) < 0.1 || std::abs(aside - 20.0) < 0.1) continue;
    const double sum = 0.5 * (chord(40.0) + chord(20.0));
    EXPECT_NEAR(sums.at(x, 30), sum, 0.02) << x;
    EXPECT_NEAR(cued.at(x, 30), 0.5 * sum, 0.02) << x;  // beta is 1/2 in the middle
    EXPECT_NEAR(front.at(x, 30), 0.5 * sum, 0.02) << x;
    EXPECT_EQ(counts.at(x, 30), (aside < 40.0 ? 1.0F : 0.0F) + (aside < 20.0 ? 2.0F : 0.0F)) << x;
  }
}

// Entering and leaving differ by little where each is large: thin walls at the end of a deep
// scene, seen from afar, and far from the origin of the world.
TEST(CpuSumsAlone, KeepThinWallsFarFromTheOrigin) {
  const glm::dvec3 center(4e6, -3e6, 2e6);
  const BoundingSphere sphere{center, 100.0};
  // Looking along y: a sheet at the eye's side starts the depths, the wall ends them.
  const ShellSet set = make_set({join(block_mesh({-60, -90, -60}, {60, 90, -50}),
                                      block_mesh({-60, 89.5, -40}, {60, 90, 60}))},
                                center);
  for (const std::optional<double> field_of_view :
       {std::optional<double>(), std::optional<double>(0.5), std::optional<double>(0.01)}) {
    const Camera camera =
        make_camera({.size = {64, 64}, .field_of_view_rad = field_of_view}, sphere);
    const Image image = draw(set, {}, camera, {.mode = PictureMode::Sum}).volume;
    const Image exact = shell_picture(set, camera, {.mode = PictureMode::Sum}).volume;
    EXPECT_NEAR(exact.at(32, 30), 0.5, 0.05);
    // Half a mm to 2^-23 of the eye's distance, or of the scene's depth without one.
    const double tolerance = field_of_view.value_or(1.0) < 0.1 ? 0.01 : 1e-4;
    EXPECT_NEAR(image.at(32, 30), exact.at(32, 30), tolerance);
    EXPECT_LE(far_off(image, exact, tolerance), 130U) << field_of_view.value_or(0.0);
  }
}

TEST(CpuSumsAlone, AreTheSameForAllThreadsAndInstructions) {
  const Scan scan = small_angiogram();
  for (const Camera& camera : cameras(scan.sphere, {120, 90})) {
    const std::vector<Tool> tools = tools_about(scan.sphere, camera).back();
    for (const PictureMode mode : kModes) {
      for (const DepthCue& cue : kCues) {
        for (const Slab& slab : {Slab{}, slabs(scan.sphere.radius_mm).back()}) {
          const RenderOptions options{.mode = mode, .cue = cue, .slab = slab};
          const Image expected = draw(scan.set, tools, camera, options).volume;
          for (const std::size_t threads : {1U, 2U, 3U}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            for (const InstructionSet set : instruction_sets()) {
              const Picture picture = draw(scan.set, tools, camera, options, {.instructions = set});
              EXPECT_EQ(picture.volume.pixels, expected.pixels) << threads;
            }
          }
        }
      }
    }
  }
}

// A surface with fewer triangles is closed still: what is entered is left, and chords are as long
// to about twice what surfaces may move.
TEST(CpuSumsAlone, DetailKeepsChordsToWhatSurfacesMove) {
  const ShellSet set = nested_balls(1, 50.0, 120);
  const Camera camera = make_camera({.size = {60, 60}, .azimuth_rad = 0.3}, {{}, 60.0});  // 2 mm
  CpuRenderer coarse({.detail_px = 1.0});
  coarse.upload(set);
  const Image image = coarse.render(camera, {.mode = PictureMode::Sum}).volume;
  EXPECT_LT(coarse.last_frame().triangles, set.shells[0].surface.triangles.size());
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const double aside = 2.0 * std::hypot(x + 0.5 - 30.0, y + 0.5 - 30.0);
      if (aside > 52.0) {
        EXPECT_EQ(image.at(x, y), 0.0F);
      }
      // Up to half the radius aside, rays meet the ball at 60 degrees or more.
      if (aside > 25.0) continue;
      EXPECT_NEAR(image.at(x, y), 2.0 * std::sqrt(2500.0 - aside * aside), 2.0 * 2.4);
    }
  }
}

}  // namespace
}  // namespace nacre::testing

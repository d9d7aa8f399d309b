// The renderer on the processor against rays, against OpenGL, and against itself.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/error.h"
#include "render/cpu/cpu_renderer.h"
#include "tests/render/cpu_test_support.h"
#include "tests/render/gl_test_support.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {
namespace {

const glm::dvec3 kCenter(100.0, -200.0, 300.0);
const BoundingSphere kSphere{kCenter, 60.0};

Image draw(const ShellSet& set, const Camera& camera, const RenderOptions& options = {},
           const CpuOptions& how = {}) {
  return testing::draw(set, {}, camera, options, how).volume;
}

void expect_exact(const ShellSet& set, const Camera& camera, const RayCheck& check = {}) {
  expect_matches_rays(set, camera, draw(set, camera), check);
}

TEST(CpuMax, SmoothLayersAreWhatTheFilterMakesOfFlatOnes) {
  const Scan scan = small_angiogram();
  for (const Camera& camera : cameras(scan.sphere, {161, 120})) {
    for (const Slab& slab : slabs(scan.sphere.radius_mm)) {
      for (const Layers layers : {Layers::Smooth, Layers::Fine}) {
        const RenderOptions options{.slab = slab, .layers = layers};
        const Plan plan = make_plan(scene_facts(scan.set), camera, options);
        EXPECT_EQ(plan.samples, layers == Layers::Fine ? 3 : 1);
        const Image flat = draw(scan.set, with_samples(camera, plan.samples), {.slab = slab});
        DequantizationMemory memory;
        Image expected;
        dequantize(flat, plan.samples, plan.layers, {}, {}, memory, expected);
        const Image drawn = draw(scan.set, camera, options);
        EXPECT_EQ(drawn.width, camera.size.x);
        EXPECT_EQ(drawn.pixels, expected.pixels);
      }
    }
  }
}

TEST(CpuMax, IsWhatRaysShowFromAllSides) {
  const ShellSet set = mixed_set(kCenter);
  for (const double azimuth : {0.0, 35.0, 160.0}) {
    for (const double elevation : {0.0, -50.0}) {
      for (const auto field_of_view : {std::optional<double>(), std::optional<double>(1.2)}) {
        expect_exact(set, make_camera({.size = {48, 40},
                                       .azimuth_rad = azimuth * kDegree,
                                       .elevation_rad = elevation * kDegree,
                                       .roll_rad = 10 * kDegree,
                                       .field_of_view_rad = field_of_view},
                                      kSphere));
      }
    }
  }
}

// Triangles of many thousand pixels, most of them outside.
TEST(CpuMax, IsWhatRaysShowOfHugeTriangles) {
  for (const auto field_of_view : {std::optional<double>(), std::optional<double>(40 * kDegree)}) {
    for (const double zoom : {3.5, 300.0, 1e5}) {
      expect_exact(mixed_set(kCenter),
                   make_camera({.size = {48, 48},
                                .elevation_rad = 35 * kDegree,
                                .zoom = zoom,  // the silhouette of a block, straight
                                .field_of_view_rad = field_of_view,
                                .look_at_mm = kCenter + glm::dvec3(20, 5, 10)},
                               kSphere));
    }
  }
}

// The eye between, inside and at the centre of shells, and where shells lie behind it.
TEST(CpuMax, IsWhatRaysShowFromInside) {
  const ShellSet set = mixed_set(kCenter);
  for (const double field_of_view : {40.0, 120.0, 170.0}) {
    for (const double distance : {0.0, 3.0, 24.0, 38.0, 55.0}) {
      expect_exact(set,
                   make_camera({.size = {32, 32},
                                .azimuth_rad = 130 * kDegree,
                                .elevation_rad = 11 * kDegree,
                                .field_of_view_rad = field_of_view * kDegree,
                                .distance_mm = distance},
                               kSphere),
                   {.off_center = 0.05});
    }
  }
}

TEST(CpuMax, ShowsNothingOfWhatIsBehindTheEye) {
  const Camera away = make_camera({.size = {16, 16},
                                   .field_of_view_rad = 60 * kDegree,
                                   .distance_mm = 1.0,
                                   .look_at_mm = kCenter + glm::dvec3(0, 59, 0)},
                                  kSphere);
  const Image image = draw(nested_balls(3, 40.0, 8, kCenter), away);
  EXPECT_EQ(*std::max_element(image.pixels.begin(), image.pixels.end()), 0.0F);
}

TEST(CpuMax, DrawsPicturesOfOnePixel) {
  const ShellSet set = nested_balls(4, 40.0, 8, kCenter);
  EXPECT_EQ(draw(set, make_camera({.size = {1, 1}}, kSphere)).at(0, 0), 1.0F);
  expect_exact(set, make_camera({.size = {1, 9}, .azimuth_rad = 0.1}, kSphere));
}

TEST(CpuMax, DrawsPicturesOf4096Pixels) {
  const Camera camera = make_camera({.size = {4096, 4096}, .azimuth_rad = 35 * kDegree}, kSphere);
  expect_exact(mixed_set(kCenter), camera, {.every = 8191});
}

TEST(CpuMax, TilesJoinToTheSamePicture) {
  const ShellSet set = mixed_set(kCenter);
  CpuRenderer renderer;
  renderer.upload(set);
  for (const Camera& camera : cameras(kSphere, {100, 70})) {
    const Image whole = renderer.render(camera).volume;
    const Plan tiled = make_plan(scene_facts(set), camera, {}, {.max_target_side = 32});
    EXPECT_LE(pixels_that_differ(whole, renderer.render(camera, tiled).volume), 10U);
  }
}

TEST(CpuMax, DrawsNothingOfNoShells) {
  const Image image = draw({}, make_camera({.size = {16, 16}}, kSphere));
  EXPECT_EQ(std::count(image.pixels.begin(), image.pixels.end(), 0.0F), 256);
}

// A byte a pixel up to 255 shells, then two.
TEST(CpuMax, KeepsHundredsOfShellsApart) {
  for (const int shells : {1, 200, 255, 256, 300}) {
    expect_exact(nested_balls(shells, 55.0, 8, kCenter),
                 make_camera({.size = {64, 64}, .azimuth_rad = 0.2}, kSphere),
                 {.every = 29, .off_center = 0.1});
  }
}

// A ball of a hundredth of a pixel is seen in the pixel whose centre it covers, or in none.
TEST(CpuMax, ShowsTinyShellsWhereTheyCoverACentre) {
  const Camera camera = make_camera({.size = {60, 60}}, kSphere);  // 2 mm a pixel
  const auto lit = [&](const glm::dvec3& center) {
    const Image image = draw(make_set({ball_mesh(center, 0.02, 6)}, kCenter), camera);
    return std::count(image.pixels.begin(), image.pixels.end(), 1.0F);
  };
  EXPECT_EQ(lit({1.0, 0.0, 1.0}), 1);
  EXPECT_EQ(lit({0.0, 0.0, 0.0}), 0);  // between four pixels
  EXPECT_EQ(lit({1.5, 0.0, 1.0}), 0);
}

TEST(CpuMax, CoversWhatOpenGlCovers) {
  const Scan scan = small_angiogram();
  CpuRenderer cpu;
  cpu.upload(scan.set);
  for (const Backend backend : {Backend::OsMesa, Backend::Egl}) {
    if (!has_backend(backend)) continue;
    GlRenderer gl(backend);
    gl.upload(scan.set);
    for (const int side : {64, 300}) {
      for (const Camera& camera : cameras(scan.sphere, {side, side})) {
        const Image ours = cpu.render(camera).volume;
        const std::size_t different = pixels_that_differ(ours, gl.render(camera).volume);
        EXPECT_LE(different, ours.pixels.size() / 10000) << name(backend) << ' ' << side;
      }
    }
  }
}

TEST(CpuMax, ACueIsWhatOpenGlMakesOfIt) {
  const Scan scan = small_angiogram();
  if (!has_backend(test_backend())) GTEST_SKIP() << "no OpenGL on this machine";
  GlRenderer gl(test_backend());
  CpuRenderer cpu;
  gl.upload(scan.set);
  cpu.upload(scan.set);
  for (const DepthCue& cue : {DepthCue{0.8, 0.2, 0.0}, DepthCue{-0.7, 0.9, 0.0}}) {
    for (Camera& camera : cameras(scan.sphere, {200, 200})) {
      const Plan plan = make_plan(scene_facts(scan.set), camera, {.cue = cue});
      const Image ours = cpu.render(camera, plan).volume;
      const Image theirs = gl.render(camera, plan).volume;
      std::size_t off = 0;
      for (std::size_t i = 0; i < ours.pixels.size(); ++i) {
        if (!(std::abs(ours.pixels[i] - theirs.pixels[i]) <= 1e-3F)) ++off;
      }
      EXPECT_LE(off, ours.pixels.size() / 10000);
    }
  }
}

// Ball and eye on the y axis: the middle pixel shows beta at the ball's nearest point.
TEST(CpuMax, ACueIsTakenAtTheNearestCrossing) {
  const ShellSet set = nested_balls(1, 30.0, 40, kCenter);
  for (const auto field_of_view : {std::optional<double>(), std::optional<double>(0.5)}) {
    const Camera camera =
        make_camera({.size = {65, 65}, .field_of_view_rad = field_of_view}, kSphere);
    // z = 0.5 at the centre, 0.75 at 30 of 60 mm towards the eye.
    EXPECT_NEAR(draw(set, camera, {.cue = {.a = 0.8, .b = 0.2}}).at(32, 32), 0.8, 1e-3);
    EXPECT_NEAR(draw(set, camera, {.cue = {.a = -0.8, .b = 1.0}}).at(32, 32), 0.8, 1e-3);
  }
}

TEST(CpuMax, IsTheSameForAllThreadsAndInstructions) {
  const Scan scan = small_angiogram();
  for (const DepthCue& cue : {DepthCue{}, DepthCue{0.8, 0.2, 0.0}}) {
    for (const Camera& camera : cameras(scan.sphere, {120, 90})) {
      const Image expected = draw(scan.set, camera, {.cue = cue});
      for (const std::size_t threads : {1U, 2U, 5U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        for (const InstructionSet set : instruction_sets()) {
          const Image image = draw(scan.set, camera, {.cue = cue}, {.instructions = set});
          EXPECT_EQ(image.pixels, expected.pixels) << threads;
        }
      }
    }
  }
}

// The outline of a ball lies within the stated pixel of the circle; without levels, within 0.1.
TEST(CpuMax, DetailMovesOutlinesByNoMoreThanAskedFor) {
  const ShellSet set = nested_balls(1, 50.0, 120, kCenter);
  const Camera camera = make_camera({.size = {60, 60}, .azimuth_rad = 0.3}, kSphere);  // 2 mm
  CpuRenderer coarse({.detail_px = 1.0});
  coarse.upload(set);
  const Image image = coarse.render(camera).volume;
  EXPECT_LT(coarse.last_frame().triangles, set.shells[0].surface.triangles.size() / 2);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const double reach_px = std::hypot(x + 0.5 - 30.0, y + 0.5 - 30.0);
      // A circle of 25 pixels, the facets of the ball itself within 0.1 of it.
      if (reach_px > 23.9 && reach_px < 26.0) continue;
      EXPECT_EQ(image.at(x, y), reach_px < 25.0 ? 1.0F : 0.0F) << x << ", " << y;
    }
  }
}

TEST(CpuMax, RefusesWhatItDoesNotDraw) {
  const ShellSet set = mixed_set(kCenter);
  const Camera camera = make_camera({.size = {16, 16}}, kSphere);
  EXPECT_TRUE(cpu_objection(make_plan(scene_facts(set), camera, {.mode = PictureMode::Iso})));
  EXPECT_THROW(draw(set, camera, {.mode = PictureMode::Iso}), Error);
  EXPECT_FALSE(cpu_objection(make_plan(scene_facts(set), camera, {})));
}

TEST(CpuMax, RefusesAPlanForShellsThatWereNotUploaded) {
  const ShellSet set = mixed_set(kCenter);
  const Camera camera = make_camera({.size = {16, 16}}, kSphere);
  CpuRenderer renderer;
  const std::array<std::uint32_t, 1> one{1};
  renderer.upload(set, scene_facts(set), one);
  EXPECT_THROW(renderer.render(camera), Error);
  EXPECT_NO_THROW(renderer.render(camera, {.hidden = {0, 2}}));
}

}  // namespace
}  // namespace nacre::testing

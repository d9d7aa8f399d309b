// Pictures that have to agree: with exact rays, between backends, ways of occlusion, tiles, orders.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "reference/shell_picture.h"
#include "tests/render/gl_test_support.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {
namespace {

const glm::dvec3 kCenter(100.0, -200.0, 300.0);
const BoundingSphere kSphere{kCenter, 60.0};
const DepthCue kRising{.a = 0.7, .b = 0.2, .beta0 = 0.1};
const DepthCue kFalling{.a = -0.6, .b = 0.9, .beta0 = 0.05};
constexpr std::array<PictureMode, 4> kModes{PictureMode::Max, PictureMode::Sum, PictureMode::Count,
                                            PictureMode::Iso};

ShellSet nest(int rings = 24) {
  return make_set({ball_mesh({}, 40.0, rings), ring_mesh({}, 25.0, 8.0, 2 * rings),
                   ball_mesh({25, 1, 2}, 5.0, rings)},
                  kCenter);
}

std::vector<Tool> rod() {
  Tool tool;
  tool.mesh = ball_mesh({}, 1.0, 16);
  tool.world_from_tool = glm::scale(glm::translate(glm::dmat4(1.0), kCenter + glm::dvec3(2, -9, 3)),
                                    glm::dvec3(70.0, 6.0, 5.0));
  return {tool};
}

std::vector<Camera> cameras(const glm::ivec2& size = {90, 70}) {
  CameraOptions options{.size = size, .azimuth_rad = 0.45, .elevation_rad = 0.3};
  std::vector<Camera> list{make_camera(options, kSphere)};
  options.field_of_view_rad = 0.7;
  list.push_back(make_camera(options, kSphere));
  options.field_of_view_rad = 1.5;
  options.distance_mm = 27.0;  // within the ring
  list.push_back(make_camera(options, kSphere));
  return list;
}

/// Pixels that differ by more than the tolerance.
std::size_t far_off(const Image& a, const Image& b, double tolerance) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    if (std::abs(a.pixels[i] - b.pixels[i]) > tolerance) ++count;
  }
  return count;
}

double tolerance_of(PictureMode mode) { return mode == PictureMode::Sum ? 0.05 : 1e-3; }

class GlAgreement : public GlTest {};

// Independent code: rays against the very triangles, in double. Silhouettes may fall to one side.
TEST_F(GlAgreement, WithExactRays) {
  const ShellSet set = nest();
  const std::vector<Tool> tools = rod();
  const ToolRays tool_rays(tools);
  for (const Camera& camera : cameras({60, 50})) {
    for (const PictureMode mode : kModes) {
      for (const DepthCue& cue : {DepthCue{}, kRising, kFalling}) {
        for (const Slab& slab : {Slab{}, Slab{-14.0, 17.0}}) {
          SCOPED_TRACE(::testing::Message() << static_cast<int>(mode) << ", a = " << cue.a
                                            << ", slab from " << slab.near_mm);
          const Picture shown =
              draw_with(tools, set, camera, {.mode = mode, .cue = cue, .slab = slab});
          const Picture exact = shell_picture(
              set, camera, {.mode = mode, .cue = cue, .slab = slab, .tools = &tool_rays});
          EXPECT_LE(far_off(shown.volume, exact.volume, tolerance_of(mode)), 30U);  // of 3000
        }
      }
    }
  }
}

TEST_F(GlAgreement, OfBothWaysOfOcclusion) {
  const ShellSet set = nest();
  for (const Camera& camera : cameras()) {
    for (const DepthCue& cue : {DepthCue{}, kRising}) {
      const RenderOptions passes{.cue = cue, .occlusion = Occlusion::Passes};
      const RenderOptions texture{.cue = cue, .occlusion = Occlusion::Texture};
      const Image one = draw_with(rod(), set, camera, passes).volume;
      const Image other = draw_with(rod(), set, camera, texture).volume;
      // Where shell and tool cross, rounding decides.
      EXPECT_LE(far_off(one, other, 1e-5), 2U);
    }
  }
}

TEST_F(GlAgreement, OfDepthFormats) {
  const ShellSet set = nest();
  for (const Camera& camera : cameras()) {
    const RenderOptions options{.cue = kRising};
    const Image exact = draw_with(rod(), set, camera, options).volume;
    for (const DepthFormat depth : {DepthFormat::D16, DepthFormat::D24}) {
      const RenderOptions coarse{.cue = kRising, .depth = depth};
      const double step = depth == DepthFormat::D16 ? 0x1p-16 : 0x1p-22;
      EXPECT_EQ(far_off(exact, draw_with(rod(), set, camera, coarse).volume, step), 0U);
    }
  }
}

TEST_F(GlAgreement, OfTiles) {
  const ShellSet set = nest();
  renderer().upload(set, {.normals = true});
  renderer().upload_tools(rod());
  for (const Camera& camera : cameras()) {
    for (const PictureMode mode : kModes) {
      const RenderOptions options{.mode = mode, .cue = kFalling};
      const Picture whole = renderer().render(camera, options);
      const Plan plan =
          make_plan(scene_facts(set, rod()), camera, options, {.max_target_side = 32});
      const Picture tiled = renderer().render(camera, plan);
      EXPECT_LE(far_off(whole.volume, tiled.volume, tolerance_of(mode)), 60U);  // of 6300
      ASSERT_TRUE(whole.tools && tiled.tools);
      std::size_t moved = 0;
      for (std::size_t i = 0; i < whole.tools->covered.size(); ++i) {
        if (whole.tools->covered[i] != tiled.tools->covered[i]) ++moved;
      }
      EXPECT_LE(moved, 10U);
    }
  }
}

TEST_F(GlAgreement, OfBackends) {
  for (const Backend kind : {Backend::Egl, Backend::OsMesa}) {
    if (!has_backend(kind)) GTEST_SKIP() << "no " << name(kind) << " on this machine";
  }
  GlRenderer egl(Backend::Egl);
  GlRenderer osmesa(Backend::OsMesa);
  for (GlRenderer* each : {&egl, &osmesa}) {
    each->upload(nest(), {.normals = true});
    each->upload_tools(rod());
  }
  const std::size_t silhouettes = egl.info().software ? 0 : 60;
  for (const Camera& camera : cameras()) {
    for (const PictureMode mode : kModes) {
      for (const Occlusion occlusion : {Occlusion::Passes, Occlusion::Texture}) {
        const RenderOptions options{.mode = mode, .cue = kRising, .occlusion = occlusion};
        const Picture one = egl.render(camera, options);
        const Picture other = osmesa.render(camera, options);
        const double tolerance = egl.info().software ? 0.0 : tolerance_of(mode);
        EXPECT_LE(far_off(one.volume, other.volume, tolerance), silhouettes);
        EXPECT_EQ(one.tools.has_value(), other.tools.has_value());
      }
    }
  }
}

// Triangles in another order add up the same, to rounding.
TEST_F(GlAgreement, OfOrdersOfTriangles) {
  const ShellSet set = nest();
  ShellSet turned = set;
  for (Shell& shell : turned.shells) {
    std::reverse(shell.surface.triangles.begin(), shell.surface.triangles.end());
  }
  for (const Camera& camera : cameras()) {
    for (const PictureMode mode : {PictureMode::Max, PictureMode::Sum, PictureMode::Count}) {
      const RenderOptions options{.mode = mode, .cue = kRising};
      EXPECT_EQ(far_off(draw(set, camera, options), draw(turned, camera, options), 1e-4), 0U);
    }
  }
}

// The sum of entering and leaving is nothing: a pixel that lost a wall would show it.
TEST_F(GlAgreement, SumsOfManyShellsAreBalanced) {
  const ShellSet set = nested_balls(200, 55.0, 24, kCenter);
  const Camera camera = make_camera({.size = {256, 256}, .azimuth_rad = 0.2}, kSphere);
  const Image image = draw(set, camera, {.mode = PictureMode::Sum});
  double largest = 0.0;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
      const double d = glm::length(ray.origin_mm - kCenter);
      if (d > 54.0) continue;
      // The integral of 1 - |p| / R, as a lost wall would be tens of mm off.
      const double half = std::sqrt(55.0 * 55.0 - d * d);
      const double truth = half - d * d * std::asinh(half / d) / 55.0;
      largest = std::max(largest, std::abs(image.at(x, y) - truth));
    }
  }
  EXPECT_LT(largest, 0.6);
}

TEST_F(GlAgreement, OfPicturesOfOnePixelAndOf4096) {
  const ShellSet set = nest(12);
  for (const PictureMode mode : kModes) {
    const RenderOptions options{.mode = mode, .cue = kRising};
    const Camera tiny = make_camera({.size = {1, 1}, .azimuth_rad = 0.2, .zoom = 100.0}, kSphere);
    // The middle pixel of many shows the same as the only one.
    const Camera odd = make_camera({.size = {31, 31}, .azimuth_rad = 0.2, .zoom = 100.0}, kSphere);
    EXPECT_NEAR(draw(set, tiny, options).at(0, 0), draw(set, odd, options).at(15, 15),
                tolerance_of(mode));
  }
  const Camera large = make_camera({.size = {4096, 4096}, .azimuth_rad = 0.2}, kSphere);
  // A tool layer of that size takes most of a gigabyte.
  const std::vector<Tool> tools =
      std::getenv("NACRE_THOROUGH") != nullptr ? rod() : std::vector<Tool>{};
  const Image image = draw_with(tools, set, large, {.mode = PictureMode::Sum}).volume;
  const Camera small = make_camera({.size = {256, 256}, .azimuth_rad = 0.2}, kSphere);
  const Image few = draw_with(tools, set, small, {.mode = PictureMode::Sum}).volume;
  std::size_t differing = 0;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const float mean =
          0.25F * (image.at(16 * x + 7, 16 * y + 7) + image.at(16 * x + 8, 16 * y + 7) +
                   image.at(16 * x + 7, 16 * y + 8) + image.at(16 * x + 8, 16 * y + 8));
      if (std::abs(mean - few.at(x, y)) > 0.5F) ++differing;
    }
  }
  EXPECT_LE(differing, 655U);  // one in a hundred: silhouettes
}

}  // namespace
}  // namespace nacre::testing

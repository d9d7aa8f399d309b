// Every mode, with cues, slabs and tools, against rays cut by the definitions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "tests/render/gl_test_support.h"
#include "tests/support/nested_shells.h"
#include "tests/support/shell_rays.h"

namespace nacre::testing {
namespace {

const glm::dvec3 kCenter(100.0, -200.0, 300.0);
const BoundingSphere kSphere{kCenter, 60.0};

/// A ball, a ring in it and a small ball in the ring's tube: nested, without symmetry.
ShellSet nest() {
  return make_set(
      {ball_mesh({}, 40.0, 10), ring_mesh({}, 25.0, 8.0, 16), ball_mesh({25, 1, 2}, 5.0, 6)},
      kCenter);
}

Tool tool_of(TriangleMesh mesh, const glm::dvec3& at_mm, double turn_rad = 0.0) {
  Tool tool;
  tool.mesh = std::move(mesh);
  tool.world_from_tool =
      glm::rotate(glm::translate(glm::dmat4(1.0), at_mm), turn_rad, {0.3, 0.5, 0.8});
  return tool;
}

/// A closed bar through shells and an open triangle beside it, partly before all shells.
std::vector<Tool> bar_and_flag() {
  std::vector<Tool> tools{
      tool_of(block_mesh({-70, -4, -5}, {70, 6, 7}), kCenter + glm::dvec3(3, 9, 8), 0.4),
      tool_of({{{0, 0, 0}, {60, 0, 5}, {0, -40, 60}}, {{0, 1, 2}}},
              kCenter + glm::dvec3(-30, -30, -55))};
  tools[1].color = {1.0F, 0.5F, 0.25F};
  return tools;
}

struct Eye {
  const char* name;
  CameraOptions options;
};

std::vector<Eye> eyes() {
  const CameraOptions aside{.size = {30, 26}, .azimuth_rad = 0.6, .elevation_rad = 0.35};
  const auto with = [&](double field_of_view, std::optional<double> distance_mm) {
    CameraOptions options = aside;
    options.field_of_view_rad = field_of_view * kDegree;
    options.distance_mm = distance_mm;
    return options;
  };
  return {{"orthographic", aside},
          {"5 degrees", with(5, {})},
          {"40 degrees", with(40, {})},
          {"120 degrees", with(120, {})},
          {"inside the outer shell", with(90, 36.0)},
          {"inside the ring", with(100, 26.0)},
          {"at the centre", with(110, 0.0)}};
}

const std::array<DepthCue, 3> kCues{
    {{}, {.a = 0.7, .b = 0.2, .beta0 = 0.1}, {.a = -0.6, .b = 0.9, .beta0 = 0.05}}};
const std::array<Slab, 4> kSlabs{{{}, {.near_mm = -12.5}, {.far_mm = 11.5}, {-21.5, 4.5}}};

using Pixel = std::function<double(double, double)>;

/// One pixel in so many is checked; all of them with NACRE_THOROUGH=1. Fewer where each costs more:
/// builds with sanitizers.
std::size_t every() {
#ifdef NDEBUG
  constexpr std::size_t usual = 7;
#else
  constexpr std::size_t usual = 53;
#endif
  return std::getenv("NACRE_THOROUGH") != nullptr ? 1 : usual;
}

/// Whether a value is what a point near the pixel's centre shows: one of nine within 1/32 of a
/// pixel does, or they show a little less and a little more (where surfaces are steep).
bool shows_nearby(double value, const Pixel& truth, int x, int y, double tolerance) {
  double least = truth(x + 0.5, y + 0.5);
  double most = least;
  for (const glm::dvec2& offset : offsets_nearby()) {
    const double nearby = truth(x + 0.5 + offset.x, y + 0.5 + offset.y);
    if (std::abs(value - nearby) <= tolerance) return true;
    least = std::min(least, nearby);
    most = std::max(most, nearby);
  }
  return most - least < 200.0 * tolerance && least <= value && value <= most;
}

/// Expects each pixel to be what is seen near its centre, and all but a few what is seen there.
void expect_pixels(const Image& image, const Pixel& truth, double tolerance,
                   double off_center = 0.03) {
  std::size_t checked = 0;
  std::size_t moved = 0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += every(), ++checked) {
    const int x = static_cast<int>(i) % image.width;
    const int y = static_cast<int>(i) / image.width;
    const double center = truth(x + 0.5, y + 0.5);
    if (std::abs(image.at(x, y) - center) <= tolerance) continue;
    ++moved;
    if (shows_nearby(image.at(x, y), truth, x, y, tolerance)) continue;
    if (++wrong <= 3) {
      ADD_FAILURE() << "pixel (" << x << ", " << y << ") shows " << image.at(x, y)
                    << ", its centre " << center;
    }
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_LE(static_cast<double>(moved), 3.0 + off_center * static_cast<double>(checked));
}

class GlModes : public GlTest {
 protected:
  using Mode = double (ShellRays::*)(double, double) const;

  /// Draws all cues and slabs from all eyes, and compares with rays.
  static void expect_rays(RenderOptions options, Mode mode, std::span<const Tool> tools,
                          double tolerance) {
    const ShellSet set = nest();
    for (const Eye& eye : eyes()) {
      const Camera camera = make_camera(eye.options, kSphere);
      for (const DepthCue& cue : kCues) {
        for (const Slab& slab : kSlabs) {
          SCOPED_TRACE(::testing::Message() << eye.name << ", a = " << cue.a << ", slab "
                                            << slab.near_mm << " to " << slab.far_mm);
          options.cue = cue;
          options.slab = slab;
          const Picture picture = draw_with(tools, set, camera, options);
          const ShellRays rays(set, tools, camera, cue, slab);
          expect_pixels(
              picture.volume, [&](double x, double y) { return (rays.*mode)(x, y); }, tolerance);
        }
      }
    }
  }
};

// Corners are rounded to 1/256 pixel, and the steepest triangles here fall by 50 mm a pixel.
constexpr double kMaxTolerance = 4e-4;  // of emissions up to 1
constexpr double kSumTolerance = 0.02;  // of up to 80 mm

TEST_F(GlModes, MaxIsWhatRaysShow) { expect_rays({}, &ShellRays::maximum, {}, kMaxTolerance); }

TEST_F(GlModes, MaxIsWhatRaysShowBeforeToolsByTexture) {
  expect_rays({.occlusion = Occlusion::Texture}, &ShellRays::maximum, bar_and_flag(),
              kMaxTolerance);
}

TEST_F(GlModes, MaxIsWhatRaysShowBeforeToolsByPasses) {
  expect_rays({.occlusion = Occlusion::Passes}, &ShellRays::maximum, bar_and_flag(), kMaxTolerance);
}

TEST_F(GlModes, SumIsWhatRaysShow) {
  expect_rays({.mode = PictureMode::Sum}, &ShellRays::sum, {}, kSumTolerance);
}

TEST_F(GlModes, SumIsWhatRaysShowBeforeTools) {
  expect_rays({.mode = PictureMode::Sum}, &ShellRays::sum, bar_and_flag(), kSumTolerance);
}

TEST_F(GlModes, CountIsWhatRaysShow) {
  expect_rays({.mode = PictureMode::Count}, &ShellRays::count, {}, 1e-5);
}

TEST_F(GlModes, CountIsWhatRaysShowBeforeTools) {
  expect_rays({.mode = PictureMode::Count}, &ShellRays::count, bar_and_flag(), 1e-5);
}

// A ball's smooth normals are those of the sphere through its vertices, nearly.
TEST_F(GlModes, LitBallsShowTheHeadlight) {
  const ShellSet set = nested_balls(2, 40.0, 20, kCenter);
  for (const Eye& eye : eyes()) {
    const Camera camera = make_camera(eye.options, kSphere);
    for (const DepthCue& cue : kCues) {
      for (const Slab& slab : kSlabs) {
        SCOPED_TRACE(::testing::Message() << eye.name << ", a = " << cue.a << ", slab "
                                          << slab.near_mm << " to " << slab.far_mm);
        const RenderOptions options{.mode = PictureMode::Iso, .cue = cue, .slab = slab};
        const Image image = draw(set, camera, options);
        const ShellRays rays(set, {}, camera, cue, slab);
        const auto lit = [&](double x, double y) { return rays.lit_ball(x, y); };
        expect_pixels(image, lit, 0.03);
      }
    }
  }
}

TEST_F(GlModes, LitShellsShowBeforeToolsOnly) {
  const ShellSet set = nested_balls(2, 40.0, 20, kCenter);
  const std::vector<Tool> tools = bar_and_flag();
  for (const Eye& eye : eyes()) {
    SCOPED_TRACE(eye.name);
    const Camera camera = make_camera(eye.options, kSphere);
    const RenderOptions options{.mode = PictureMode::Iso, .cue = kCues[1]};
    const Image image = draw_with(tools, set, camera, options).volume;
    const ShellRays rays(set, tools, camera, kCues[1]);
    expect_pixels(
        image, [&](double x, double y) { return rays.lit_ball(x, y); }, 0.03);
  }
}

// Tools are drawn as they are: slabs do not cut them, and the near plane does.
TEST_F(GlModes, TheToolLayerShowsTheNearestTool) {
  const ShellSet set = nest();
  const std::vector<Tool> tools = bar_and_flag();
  for (const Eye& eye : eyes()) {
    const Camera camera = make_camera(eye.options, kSphere);
    for (const DepthCue& cue : kCues) {
      SCOPED_TRACE(::testing::Message() << eye.name << ", a = " << cue.a);
      const RenderOptions options{.cue = cue, .slab = {-5.0, 1.0}};
      const Picture picture = draw_with(tools, set, camera, options);
      ASSERT_TRUE(picture.tools.has_value());
      const ShellRays rays(set, tools, camera, cue);
      for (int channel = 0; channel < 3; ++channel) {
        Image image = make_image(camera.size.x, camera.size.y);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
          const bool covered = picture.tools->covered[i] != 0;
          image.pixels[i] = covered ? picture.tools->colors[i][channel] : -1.0F;
        }
        const auto shown = [&](double x, double y) {
          const std::optional<glm::vec3> color = rays.tool_color(x, y);
          return color ? static_cast<double>((*color)[channel]) : -1.0;
        };
        expect_pixels(image, shown, 2e-3, 0.05);
      }
    }
  }
}

TEST_F(GlModes, ToolsOutsideThePictureLeaveNoLayer) {
  const Camera camera = make_camera({.size = {20, 20}}, kSphere);
  const std::vector<Tool> tools{
      tool_of(block_mesh({-5, -5, -5}, {5, 5, 5}), kCenter + glm::dvec3(500, 0, 0))};
  const Picture picture = draw_with(tools, nest(), camera);
  EXPECT_FALSE(picture.tools.has_value());
  EXPECT_EQ(pixels_that_differ(picture.volume, draw(nest(), camera)), 0U);
}

TEST_F(GlModes, ToolsShowWithoutAnyVolume) {
  const std::vector<Tool> tools{tool_of(block_mesh({-5, -5, -5}, {5, 5, 5}), kCenter)};
  for (const PictureMode mode :
       {PictureMode::Max, PictureMode::Sum, PictureMode::Count, PictureMode::Iso}) {
    const Camera camera = make_camera({.size = {20, 20}}, kSphere);
    ShellSet none;
    none.center_mm = kCenter;
    const Picture picture = draw_with(tools, none, camera, {.mode = mode});
    ASSERT_TRUE(picture.tools.has_value());
    EXPECT_EQ(picture.tools->covered[10 * 20 + 10], 1);
    // The block's face is seen straight on.
    EXPECT_NEAR(picture.tools->colors[10 * 20 + 10].y, 0.7F, 1e-6F);
    EXPECT_EQ(*std::max_element(picture.volume.pixels.begin(), picture.volume.pixels.end()), 0.0F);
  }
}

}  // namespace
}  // namespace nacre::testing

#include "reference/shell_picture.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "reference/pixel_footprint.h"
#include "tests/support/expect_error.h"
#include "tests/support/nested_shells.h"
#include "tests/support/ray_maximum.h"
#include "tests/support/shell_segments.h"

namespace nacre {
namespace {

using testing::block_mesh;
using testing::expect_error;
using testing::first_tool_mm;
using testing::make_set;
using testing::nested_balls;
using testing::ray_maximum;
using testing::segment_integral;
using testing::segment_maximum;
using testing::shell_segments;
using testing::ShellSegment;

#ifdef NDEBUG
constexpr int kSide = 25;
constexpr int kRings = 14;
#else
constexpr int kSide = 9;
constexpr int kRings = 6;
#endif

constexpr float kFloat = 1e-6f;  // of a picture's value
const glm::dvec3 kCenter{30, -70, 11};
const BoundingSphere kSphere{kCenter, 10.0};
const DepthCue kRising{0.75, 0.25, 0.0};
const DepthCue kFalling{-0.5, 0.9, 0.1};

/// Views from which no ray hits an edge.
std::vector<CameraOptions> views() {
  const glm::ivec2 size(kSide, kSide - 2);
  const glm::dvec3 beside = kCenter + glm::dvec3(0.11, -0.23, 0.17);
  std::vector<CameraOptions> options{
      {.size = size, .azimuth_rad = 0.4321, .elevation_rad = 0.25, .zoom = 1.1},
      {.size = size, .view = NamedView::Superior, .roll_rad = 0.7, .field_of_view_rad = 0.9},
      {.size = size, .azimuth_rad = 2.1, .field_of_view_rad = 1.3, .distance_mm = 3.3},
      {.size = size, .elevation_rad = -1.1, .field_of_view_rad = 1.0, .distance_mm = 0.5},
  };
  for (CameraOptions& view : options) view.look_at_mm = beside;
  return options;
}

/// A floor that cuts through the shells at a slant.
Tool floor_tool() {
  Tool tool;
  tool.mesh = {{{-9, -9, -3}, {9, -9, 1}, {9, 9, 2}, {-9, 9, -2}}, {{0, 1, 2}, {0, 2, 3}}};
  tool.world_from_tool[3] = glm::dvec4(kCenter, 1.0);
  return tool;
}

/// A view's rays, each with its parts within shells.
struct ViewRays {
  Camera camera;
  std::vector<Ray> rays;
  std::vector<std::vector<ShellSegment>> segments;

  ViewRays(const ShellSet& set, const CameraOptions& view) : camera(make_camera(view, kSphere)) {
    for (int y = 0; y < camera.size.y; ++y) {
      for (int x = 0; x < camera.size.x; ++x) {
        rays.push_back(picture_ray(camera, x + 0.5, y + 0.5));
        segments.push_back(shell_segments(set, rays.back()));
      }
    }
  }
};

/// What of a ray shows, before a tool if there is one.
RayInterval shown_interval(const Camera& camera, const Ray& ray, const Slab& slab,
                           const Tool* tool) {
  RayInterval interval = visible_interval(camera, ray, slab);
  if (tool == nullptr) return interval;
  const double eye = camera.perspective ? 0.0 : -INFINITY;
  interval.t_end_mm = std::min(interval.t_end_mm, first_tool_mm(*tool, ray, eye));
  return interval;
}

/// Compares pictures of nested balls with `expected(set, segments, camera, cue, ray)` for every
/// view, cue, slab, with and without a tool.
template <class Expected>
void expect_pictures(PictureMode mode, Expected&& expected) {
  const ShellSet set = nested_balls(4, 7.0, kRings, kCenter);
  const Tool tool = floor_tool();
  const ToolRays tools({&tool, 1});
  for (const CameraOptions& view : views()) {
    const ViewRays seen(set, view);
    for (const DepthCue& cue : {DepthCue{}, kRising, kFalling}) {
      for (const Slab& slab : {Slab{}, Slab{-4.1, 2.3}}) {
        for (const bool with_tool : {false, true}) {
          const Picture picture = shell_picture(
              set, seen.camera,
              {.mode = mode, .cue = cue, .slab = slab, .tools = with_tool ? &tools : nullptr});
          for (std::size_t i = 0; i < seen.rays.size(); ++i) {
            const RayInterval shown =
                shown_interval(seen.camera, seen.rays[i], slab, with_tool ? &tool : nullptr);
            const double value = expected(set, testing::clip(seen.segments[i], shown), seen.camera,
                                          cue, seen.rays[i]);
            EXPECT_NEAR(picture.volume.pixels[i], value, kFloat * (1.0 + value)) << "pixel " << i;
          }
        }
      }
    }
  }
}

TEST(ShellPicture, MaximumIsTheLargestCuedEmissionOfTheRaysParts) {
  expect_pictures(PictureMode::Max, segment_maximum);
}

TEST(ShellPicture, SumIsTheIntegralOverTheRaysParts) {
  expect_pictures(PictureMode::Sum, segment_integral);
}

TEST(ShellPicture, ToolsCoverWhereRaysMeetThemWhateverTheSlab) {
  const ShellSet set = nested_balls(1, 7.0, 5, kCenter);
  const Tool tool = floor_tool();
  const ToolRays tools({&tool, 1});
  for (const CameraOptions& view : views()) {
    const Camera camera = make_camera(view, kSphere);
    const Picture picture = shell_picture(set, camera, {.slab = {-0.1, 0.1}, .tools = &tools});
    bool any = false;
    for (int y = 0; y < camera.size.y; ++y) {
      for (int x = 0; x < camera.size.x; ++x) {
        const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
        const bool covered = std::isfinite(shown_interval(camera, ray, {}, &tool).t_end_mm);
        any |= covered;
        if (!picture.tools) continue;
        const auto pixel = static_cast<std::size_t>(x + camera.size.x * y);
        EXPECT_EQ(picture.tools->covered[pixel], covered ? 1 : 0);
        EXPECT_EQ(picture.tools->colors[pixel].b > 0.0f, covered);
      }
    }
    EXPECT_EQ(picture.tools.has_value(), any);
  }
}

TEST(ShellPicture, UncuedMaximumIsThatOfAnIndependentSearchWithShellsHidden) {
  const ShellSet set = nested_balls(5, 9.0, kRings, kCenter);
  for (const CameraOptions& view : views()) {
    const Camera camera = make_camera(view, kSphere);
    if (camera.perspective && camera.eye_distance_mm < 10.0) continue;  // starts inside
    for (const int hidden : {-1, 0, 2, 4}) {
      ShellPictureOptions options;
      if (hidden >= 0) options.hidden.push_back(static_cast<std::uint32_t>(hidden));
      const Picture picture = shell_picture(set, camera, options);
      for (int y = 0; y < camera.size.y; ++y) {
        for (int x = 0; x < camera.size.x; ++x) {
          const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
          EXPECT_EQ(picture.volume.at(x, y),
                    static_cast<float>(ray_maximum(set, ray, camera.perspective, hidden)));
        }
      }
    }
  }
}

/// Two nested blocks seen head-on: outer from -4 to 4, inner from -1 to 3 along y (away).
ShellSet nested_blocks() {
  return make_set({block_mesh({-4, -4, -4}, {4, 4, 4}), block_mesh({-2, -1, -2}, {2, 3, 2})},
                  kCenter);
}

TEST(ShellPicture, HeadOnBlocksHaveTheirClosedForms) {
  const ShellSet set = nested_blocks();
  const Camera camera = make_camera({.size = {5, 5}}, kSphere);
  const auto at = [&](const ShellPictureOptions& options, int x) {
    return shell_picture(set, camera, options).volume.at(x, 2);
  };
  // Pixel 2 looks through both (by the diagonal of the faces), pixel 1 through the outer alone.
  EXPECT_FLOAT_EQ(at({.mode = PictureMode::Sum}, 2), 0.5f * 8 + 0.5f * 4);
  EXPECT_FLOAT_EQ(at({.mode = PictureMode::Sum}, 0), 0.0f);
  EXPECT_FLOAT_EQ(at({.mode = PictureMode::Count}, 2), 0.5f * 2 + 1.0f * 2);
  EXPECT_FLOAT_EQ(at({.mode = PictureMode::Count, .slab = {-2, 2}}, 2), 1.0f);
  // Depth s has z = (10 - s) / 20: the mean over the outer block is 1/2, over the inner 9/20.
  const DepthCue cue{2.0, 0.5, 0.0};
  EXPECT_FLOAT_EQ(at({.mode = PictureMode::Sum, .cue = cue}, 2), 4 * 1.5f + 2 * 1.4f);
  EXPECT_FLOAT_EQ(at({.mode = PictureMode::Max, .cue = cue}, 2), 0.5f + 2 * 11.0f / 20);
  // Slabs start and end inside.
  EXPECT_FLOAT_EQ(at({.mode = PictureMode::Sum, .slab = {0, 2}}, 2), 2.0f);
  EXPECT_FLOAT_EQ(at({.mode = PictureMode::Max, .cue = cue, .slab = {0.5, 1}}, 2),
                  0.5f + 2 * 9.5f / 20);
  EXPECT_FLOAT_EQ(at({.mode = PictureMode::Max, .cue = kFalling, .slab = {0.5, 1}}, 2),
                  1.0f - 0.5f * 9.0f / 20);
  EXPECT_FLOAT_EQ(at({.mode = PictureMode::Max, .slab = {-3, -2}}, 2), 0.5f);
  EXPECT_FLOAT_EQ(at({.mode = PictureMode::Max, .slab = {5, 6}}, 2), 0.0f);
}

TEST(ShellPicture, AHiddenShellLeavesItsLayerToThePreviousOne) {
  const ShellSet set = nested_balls(4, 8.0, kRings, kCenter);
  ShellSet without = set;
  without.shells.erase(without.shells.begin() + 2);
  const Camera camera = make_camera(views()[0], kSphere);
  for (const PictureMode mode :
       {PictureMode::Max, PictureMode::Sum, PictureMode::Count, PictureMode::Iso}) {
    const Slab slab{-2.0, 3.0};
    const Picture hidden =
        shell_picture(set, camera, {.mode = mode, .cue = kRising, .slab = slab, .hidden = {2}});
    const Picture absent =
        shell_picture(without, camera, {.mode = mode, .cue = kRising, .slab = slab});
    EXPECT_EQ(hidden.volume.pixels, absent.volume.pixels);
  }
}

TEST(ShellPicture, SumsOfAFineBallAreItsChords) {
  const ShellSet set = nested_balls(1, 8.0, 120, kCenter);
  const Camera camera = make_camera({.size = {15, 15}, .azimuth_rad = 0.3}, kSphere);
  const Image sum = shell_picture(set, camera, {.mode = PictureMode::Sum}).volume;
  for (int y = 0; y < 15; ++y) {
    for (int x = 0; x < 15; ++x) {
      const double off = 10.0 * glm::length(picture_offset(camera, x + 0.5, y + 0.5));
      const double chord = off < 8.0 ? 2.0 * std::sqrt(64.0 - off * off) : 0.0;
      if (std::abs(off - 8.0) < 0.1) continue;
      EXPECT_NEAR(sum.at(x, y), chord, 0.01);
    }
  }
}

TEST(ShellPicture, IsoLightsAFineBallLikeASphere) {
  const ShellSet set = nested_balls(3, 9.0, 60, kCenter);
  const Camera camera = make_camera({.size = {15, 15}, .azimuth_rad = 0.3}, kSphere);
  for (const std::uint32_t hidden : {1U, 0U}) {  // the outermost shown is seen
    const double radius = hidden == 0 ? 6.0 : 9.0;
    const Image iso =
        shell_picture(set, camera, {.mode = PictureMode::Iso, .cue = kRising, .hidden = {hidden}})
            .volume;
    for (int y = 0; y < 15; ++y) {
      for (int x = 0; x < 15; ++x) {
        const double off = 10.0 * glm::length(picture_offset(camera, x + 0.5, y + 0.5));
        if (std::abs(off - radius) < 0.5) continue;
        const double ahead = off < radius ? std::sqrt(radius * radius - off * off) : 0.0;
        const double expected =
            off < radius ? (0.2 + 0.8 * ahead / radius) * (0.25 + 0.75 * (10.0 + ahead) / 20.0)
                         : 0.0;
        EXPECT_NEAR(iso.at(x, y), expected, 3e-3);
      }
    }
  }
}

TEST(ShellPicture, IsoLightsShellsOnTheirOutsideOnly) {
  const ShellSet set = nested_balls(1, 9.0, 30, kCenter);
  const Camera inside =
      make_camera({.size = {5, 5}, .field_of_view_rad = 1.0, .distance_mm = 0.0}, kSphere);
  const Image iso = shell_picture(set, inside, {.mode = PictureMode::Iso}).volume;
  for (const float value : iso.pixels) EXPECT_FLOAT_EQ(value, 0.2f);
}

TEST(ShellPicture, EveryRayOfAPictureOnTheLatticeIsBalanced) {
  // Rays along edges and through vertices throughout: sums would show any gap by a whole chord.
  std::vector<TriangleMesh> surfaces{block_mesh({-4, -4, -4}, {4, 4, 4})};
  const ShellSet set = make_set(surfaces, glm::dvec3(0.0));
  const Camera camera = make_camera({.size = {21, 21}}, {glm::dvec3(0.0), 10.5});
  const Image sum = shell_picture(set, camera, {.mode = PictureMode::Sum}).volume;
  for (const float value : sum.pixels) EXPECT_TRUE(value == 0.0f || value == 8.0f) << value;
  EXPECT_EQ(sum.at(10, 10), 8.0f);
  EXPECT_EQ(sum.at(7, 13), 8.0f);
  EXPECT_EQ(sum.at(5, 10), 0.0f);
}

TEST(ShellPicture, IsTheSameForAnyNumberOfThreads) {
  const ShellSet set = nested_balls(3, 9.0, 40, kCenter);
  const Camera camera = make_camera(views()[1], kSphere);
  for (const PictureMode mode :
       {PictureMode::Max, PictureMode::Sum, PictureMode::Count, PictureMode::Iso}) {
    const ShellPictureOptions options{.mode = mode, .cue = kRising};
    const Picture many = shell_picture(set, camera, options);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(shell_picture(set, camera, options).volume.pixels, many.volume.pixels);
  }
}

#ifdef NDEBUG  // a million pixels
TEST(ShellPicture, LargePicturesArePaintedRowsAtATime) {
  const ShellSet set = nested_blocks();
  const Camera large = make_camera({.size = {3000, 350}}, kSphere);
  const Image picture = shell_picture(set, large, {}).volume;
  for (int y = 0; y < 350; ++y) {
    for (int x = 0; x < 3000; x += 7) {
      const glm::dvec2 p = 10.0 * glm::abs(picture_offset(large, x + 0.5, y + 0.5));
      const double off = std::max(p.x, p.y);
      ASSERT_EQ(picture.at(x, y), off < 2.0 ? 1.0f : off < 4.0 ? 0.5f : 0.0f) << x << ", " << y;
    }
  }
}
#endif

TEST(ShellPicture, NothingShowsNothing) {
  const Camera camera = make_camera({.size = {3, 3}}, kSphere);
  EXPECT_EQ(shell_picture({}, camera).volume.pixels, std::vector<float>(9, 0.0f));
  ShellSet set = nested_balls(2, 9.0, 8, kCenter);
  const Picture hidden = shell_picture(set, camera, {.hidden = {0, 1}});
  EXPECT_EQ(hidden.volume.pixels, std::vector<float>(9, 0.0f));
  set.shells[1].surface = {};  // unreached
  EXPECT_EQ(shell_picture(set, camera).volume.at(1, 1), 0.5f);
}

TEST(ShellPicture, RefusesWhatCannotBeShown) {
  const ShellSet set = nested_balls(2, 9.0, 8, kCenter);
  const Camera camera = make_camera({.size = {3, 3}}, kSphere);
  expect_error(ErrorCode::BadArgument, "hidden shells",
               [&] { shell_picture(set, camera, {.hidden = {2}}); });
  expect_error(ErrorCode::BadArgument, "slab", [&] {
    shell_picture(set, camera, {.slab = {3, 3}});
  });
  expect_error(ErrorCode::BadArgument, "cue", [&] {
    shell_picture(set, camera, {.cue = {-2, 1, 0}});
  });
}

TEST(PixelFootprint, HoldsEveryPixelWhoseRayMeetsTheTriangle) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const CameraOptions& view : views()) {
    CameraOptions small = view;
    small.size = {17, 12};
    const Camera camera = make_camera(small, kSphere);
    const PixelFootprint footprint(camera);
    const glm::dvec3 from = camera.perspective ? eye_mm(camera) : kCenter;
    for (int trial = 0; trial < 200; ++trial) {
      // About the eye, from far larger than the sphere to far smaller than what is cut off.
      const double size = std::pow(10.0, 4.0 * unit(random) - 2.0);
      std::array<glm::dvec3, 3> corners;
      for (glm::dvec3& p : corners) {
        p = from + size * glm::dvec3(unit(random), unit(random), unit(random));
      }
      const PixelRange range = footprint(corners);
      for (int y = 0; y < camera.size.y; ++y) {
        for (int x = 0; x < camera.size.x; ++x) {
          const RayCoordinates along(picture_ray(camera, x + 0.5, y + 0.5));
          const auto met = crossing(along(corners[0]), along(corners[1]), along(corners[2]));
          if (!met || (camera.perspective && met->t_mm < 0.0)) continue;
          EXPECT_TRUE(x >= range.first.x && x <= range.last.x && y >= range.first.y &&
                      y <= range.last.y);
        }
      }
    }
  }
}

}  // namespace
}  // namespace nacre

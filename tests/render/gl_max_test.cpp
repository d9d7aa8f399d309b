#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "tests/render/gl_test_support.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {
namespace {

const glm::dvec3 kCenter(100.0, -200.0, 300.0);
const BoundingSphere kSphere{kCenter, 60.0};

class GlMax : public GlTest {
 protected:
  static void expect_exact(const ShellSet& set, const Camera& camera, const RayCheck& check = {}) {
    expect_matches_rays(set, camera, draw(set, camera), check);
  }
};

TEST_F(GlMax, IsWhatRaysShowFromAllSides) {
  const ShellSet set = mixed_set(kCenter);
  for (const double azimuth : {0.0, 35.0, 160.0}) {
    for (const double elevation : {0.0, -50.0}) {
      expect_exact(set, make_camera({.size = {48, 40},
                                     .azimuth_rad = azimuth * kDegree,
                                     .elevation_rad = elevation * kDegree,
                                     .roll_rad = 10 * kDegree},
                                    kSphere));
    }
  }
}

TEST_F(GlMax, IsWhatRaysShowInPerspective) {
  const ShellSet set = mixed_set(kCenter);
  for (const double field_of_view : {5.0, 40.0, 120.0}) {
    expect_exact(set, make_camera({.size = {40, 48},
                                   .azimuth_rad = 35 * kDegree,
                                   .elevation_rad = 20 * kDegree,
                                   .field_of_view_rad = field_of_view * kDegree},
                                  kSphere));
  }
}

TEST_F(GlMax, IsWhatRaysShowZoomedAndOffCentre) {
  const ShellSet set = mixed_set(kCenter);
  for (const std::optional<double> field_of_view :
       {std::optional<double>(), std::optional<double>(40 * kDegree)}) {
    expect_exact(set, make_camera({.size = {48, 48},
                                   .azimuth_rad = 35 * kDegree,
                                   .zoom = 3.5,
                                   .field_of_view_rad = field_of_view,
                                   .look_at_mm = kCenter + glm::dvec3(15, 3, 20)},
                                  kSphere));
    expect_exact(set, make_camera({.size = {48, 48},
                                   .elevation_rad = 35 * kDegree,
                                   .zoom = 300.0,  // the silhouette of a block, straight
                                   .field_of_view_rad = field_of_view,
                                   .look_at_mm = kCenter + glm::dvec3(20, 5, 10)},
                                  kSphere));
  }
}

// Float positions are relative to the set's centre, wherever in the world that is.
TEST_F(GlMax, IsExactFarFromTheOrigin) {
  const glm::dvec3 far(1.0e6, -3.0e6, 0.5e6);
  expect_exact(mixed_set(far),
               make_camera({.size = {48, 48}, .azimuth_rad = 35 * kDegree}, {far, 60.0}));
  expect_exact(mixed_set(far), make_camera({.size = {48, 48},
                                            .azimuth_rad = 35 * kDegree,
                                            .field_of_view_rad = 30 * kDegree},
                                           {far, 60.0}));
}

/// An arm of 4 to 6 mm along +x (dim), +y (brighter) and +z (brightest), of different reach.
ShellSet arms() {
  return make_set({block_mesh({40, -3, -3}, {50, 3, 3}), block_mesh({-3, 30, -3}, {3, 40, 3}),
                   block_mesh({-3, -3, 20}, {3, 3, 30})},
                  kCenter);
}

/// Where a picture of 120 x 120 pixels, 1 mm a pixel, shows the point (x to the right, y up).
float at(const Image& image, int x, int y) { return image.at(60 + x, 60 - y); }

// Written out by hand, as radiology has them: no camera code tells these places.
TEST_F(GlMax, NamedViewsAreNeitherMirroredNorTurned) {
  struct Expected {
    NamedView view;
    glm::ivec2 left, posterior, superior;  // where the arms point in the picture
  };
  const std::array<Expected, 6> views{{{NamedView::Anterior, {1, 0}, {0, 0}, {0, 1}},
                                       {NamedView::Posterior, {-1, 0}, {0, 0}, {0, 1}},
                                       {NamedView::Left, {0, 0}, {1, 0}, {0, 1}},
                                       {NamedView::Right, {0, 0}, {-1, 0}, {0, 1}},
                                       {NamedView::Superior, {-1, 0}, {0, -1}, {0, 0}},
                                       {NamedView::Inferior, {1, 0}, {0, -1}, {0, 0}}}};
  for (const Expected& expected : views) {
    const Image image =
        draw(arms(), make_camera({.size = {120, 120}, .view = expected.view}, kSphere));
    const auto shows = [&](const glm::ivec2& way, int reach) {
      return at(image, way.x * reach, way.y * reach);
    };
    EXPECT_EQ(shows(expected.superior, 25), 1.0F) << name(expected.view);
    if (expected.left != glm::ivec2(0)) {
      EXPECT_EQ(shows(expected.left, 45), 1.0F / 3.0F) << name(expected.view);
      EXPECT_EQ(shows(-expected.left, 45), 0.0F) << name(expected.view);
    }
    if (expected.posterior != glm::ivec2(0)) {
      EXPECT_EQ(shows(expected.posterior, 35), 2.0F / 3.0F) << name(expected.view);
      EXPECT_EQ(shows(-expected.posterior, 35), 0.0F) << name(expected.view);
    }
  }
}

TEST_F(GlMax, DrawsPicturesOfOnePixel) {
  const ShellSet set = nested_balls(4, 40.0, 8, kCenter);
  const Image image = draw(set, make_camera({.size = {1, 1}}, kSphere));
  EXPECT_EQ(image.at(0, 0), 1.0F);
  expect_exact(set, make_camera({.size = {1, 9}, .azimuth_rad = 0.1}, kSphere));
}

TEST_F(GlMax, DrawsPicturesOf4096Pixels) {
  const Camera camera = make_camera({.size = {4096, 4096}, .azimuth_rad = 35 * kDegree}, kSphere);
  expect_exact(mixed_set(kCenter), camera, {.every = 8191});
}

TEST_F(GlMax, TilesJoinToTheSamePicture) {
  const ShellSet set = mixed_set(kCenter);
  for (const std::optional<double> field_of_view :
       {std::optional<double>(), std::optional<double>(60 * kDegree)}) {
    const Camera camera = make_camera(
        {.size = {100, 70}, .azimuth_rad = 35 * kDegree, .field_of_view_rad = field_of_view},
        kSphere);
    const Image whole = draw(set, camera);
    const Image tiled =
        renderer()
            .render(camera, make_plan(scene_facts(set), camera, {}, {.max_target_side = 32}))
            .volume;
    EXPECT_EQ(renderer().last_frame().passes, 12U);
    EXPECT_LE(pixels_that_differ(whole, tiled), 10U);  // silhouettes, rounded differently
    expect_matches_rays(set, camera, tiled, {.every = 3});
  }
}

TEST_F(GlMax, DrawsNothingOfNoShells) {
  const Image image = draw({}, make_camera({.size = {16, 16}}, kSphere));
  EXPECT_EQ(std::count(image.pixels.begin(), image.pixels.end(), 0.0F), 256);
}

TEST_F(GlMax, DrawsOneShell) {
  expect_exact(nested_balls(1, 40.0, 8, kCenter), make_camera({.size = {32, 32}}, kSphere));
}

TEST_F(GlMax, KeepsTwoHundredShellsApartInEveryDepthFormat) {
  const ShellSet set = nested_balls(200, 55.0, 8, kCenter);
  const Camera camera = make_camera({.size = {64, 64}, .azimuth_rad = 0.2}, kSphere);
  const Image image = draw(set, camera);
  expect_matches_rays(set, camera, image, {.every = 29, .off_center = 0.1});
  for (const DepthFormat depth : {DepthFormat::D16, DepthFormat::D24}) {
    EXPECT_EQ(pixels_that_differ(image, draw(set, camera, {.depth = depth})), 0U) << name(depth);
  }
}

TEST_F(GlMax, ShowsTheBrightestOfEqualShells) {
  const TriangleMesh block = block_mesh({-20, -20, -20}, {20, 20, 20});
  expect_exact(make_set({block, block, block}, kCenter),
               make_camera({.size = {32, 32}, .azimuth_rad = 0.3}, kSphere));
}

TEST_F(GlMax, SharesARankAmongEqualRepresentatives) {
  ShellSet set = nested_balls(3, 40.0, 8, kCenter);
  set.shells[1].representative = set.shells[0].representative;
  expect_exact(set, make_camera({.size = {32, 32}}, kSphere));
}

TEST_F(GlMax, GoesByRepresentativesAlsoWhereTheyFallInwards) {
  ShellSet set = nested_balls(3, 40.0, 8, kCenter);
  std::swap(set.shells[0].representative, set.shells[2].representative);
  expect_exact(set, make_camera({.size = {32, 32}}, kSphere));
}

// The eye between, inside and at the centre of shells, and where shells lie behind it.
TEST_F(GlMax, IsWhatRaysShowFromInside) {
  const ShellSet set = mixed_set(kCenter);
  for (const double field_of_view : {40.0, 120.0, 170.0}) {
    for (const double distance : {0.0, 3.0, 24.0, 38.0, 55.0}) {
      for (const double azimuth : {0.0, 130.0}) {
        SCOPED_TRACE(::testing::Message() << field_of_view << " degrees, " << distance << " mm, "
                                          << azimuth << " degrees round");
        expect_exact(set,
                     make_camera({.size = {32, 32},
                                  .azimuth_rad = azimuth * kDegree,
                                  .elevation_rad = 11 * kDegree,
                                  .field_of_view_rad = field_of_view * kDegree,
                                  .distance_mm = distance},
                                 kSphere),
                     {.off_center = 0.05});
      }
    }
  }
}

TEST_F(GlMax, ShowsNothingOfWhatIsBehindTheEye) {
  const Camera away = make_camera({.size = {16, 16},
                                   .field_of_view_rad = 60 * kDegree,
                                   .distance_mm = 1.0,
                                   .look_at_mm = kCenter + glm::dvec3(0, 59, 0)},
                                  kSphere);
  const Image image = draw(nested_balls(3, 40.0, 8, kCenter), away);
  EXPECT_EQ(*std::max_element(image.pixels.begin(), image.pixels.end()), 0.0F);
}

TEST_F(GlMax, LeavesAHiddenLayerToTheShellAround) {
  const ShellSet set = nested_balls(4, 40.0, 8, kCenter);
  const Camera camera = make_camera({.size = {48, 48}}, kSphere);
  expect_matches_rays(set, camera, draw(set, camera, {.hidden = {2}}), {.hidden = 2});
}

TEST_F(GlMax, AppliesACueWithoutSlopeAsOneFactor) {
  const ShellSet set = nested_balls(4, 40.0, 8, kCenter);
  const Camera camera = make_camera({.size = {48, 48}}, kSphere);
  const Image plain = draw(set, camera);
  const Image cued = draw(set, camera, {.cue = {.a = 0.0, .b = 0.25, .beta0 = 0.25}});
  for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
    ASSERT_EQ(cued.pixels[i], 0.5F * plain.pixels[i]);
  }
}

}  // namespace
}  // namespace nacre::testing

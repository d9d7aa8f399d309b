#include "render/gl/backends.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <thread>

#include "core/error.h"
#include "tests/render/gl_test_support.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {
namespace {

constexpr std::array<Backend, 2> kKinds{Backend::Egl, Backend::OsMesa};
const BoundingSphere kSphere{{0.0, 0.0, 0.0}, 60.0};

ShellSet ring_in_ball() {
  return make_set({ball_mesh({}, 40.0, 20), ring_mesh({}, 25.0, 8.0, 40)});
}

Camera camera(double azimuth_rad = 0.4) {
  return make_camera({.size = {200, 160}, .azimuth_rad = azimuth_rad, .elevation_rad = 0.3},
                     kSphere);
}

Image draw_with(GlRenderer& renderer, double azimuth_rad = 0.4) {
  renderer.upload(ring_in_ball());
  return renderer.render(camera(azimuth_rad)).volume;
}

TEST(Backends, NamesAreRoundTrips) {
  for (const char* wanted : {"auto", "egl", "osmesa"}) {
    ASSERT_TRUE(backend(wanted).has_value());
    EXPECT_EQ(name(*backend(wanted)), wanted);
  }
  EXPECT_FALSE(backend("glx").has_value());
}

TEST(Backends, ListSaysWhatWorksAndWhatNot) {
  const BackendList list = list_backends();
  for (const BackendInfo& info : list.working) {
    EXPECT_NE(info.backend, Backend::Auto);
    EXPECT_FALSE(info.platform.empty());
    EXPECT_FALSE(info.renderer.empty());
    EXPECT_FALSE(info.version.empty());
    EXPECT_TRUE(has_backend(info.backend));
  }
  for (const LeftOut& failure : list.not_working) EXPECT_FALSE(failure.why.empty());
}

TEST(Backends, AutoTakesTheFirstOfTheList) {
  const BackendList list = list_backends();
  if (list.working.empty()) GTEST_SKIP() << "no OpenGL on this machine";
  const BackendInfo opened = open_backend(Backend::Auto).info;
  EXPECT_EQ(opened.backend, list.working.front().backend);
  EXPECT_EQ(opened.platform, list.working.front().platform);
}

// Both in one process, alternating: neither disturbs the other's context.
TEST(Backends, EglAndOsMesaAgreeSideBySide) {
  for (const Backend kind : kKinds) {
    if (!has_backend(kind)) GTEST_SKIP() << "no " << name(kind) << " on this machine";
  }
  GlRenderer egl(Backend::Egl);
  GlRenderer osmesa(Backend::OsMesa);
  egl.upload(ring_in_ball());
  osmesa.upload(ring_in_ball());
  // Hardware may round corners to the pixel grid differently from Mesa's own renderer.
  const std::size_t silhouettes = egl.info().software ? 0 : 30;
  for (const double azimuth_rad : {0.0, 0.4, 1.1}) {
    EXPECT_LE(pixels_that_differ(egl.render(camera(azimuth_rad)).volume,
                                 osmesa.render(camera(azimuth_rad)).volume),
              silhouettes);
  }
}

TEST(Backends, RenderersComeAndGo) {
  for (const Backend kind : kKinds) {
    if (!has_backend(kind)) continue;
    GlRenderer kept(kind);
    const Image image = draw_with(kept);
    for (int i = 0; i < 5; ++i) {
      GlRenderer passing(kind);
      EXPECT_EQ(pixels_that_differ(draw_with(passing), image), 0U);
    }
    EXPECT_EQ(pixels_that_differ(draw_with(kept), image), 0U);
    kept = GlRenderer(kind);
    EXPECT_EQ(pixels_that_differ(draw_with(kept), image), 0U);
  }
}

TEST(Backends, ARendererMayBeUsedFromAnotherThread) {
  for (const Backend kind : kKinds) {
    if (!has_backend(kind)) continue;
    auto renderer = std::make_unique<GlRenderer>(kind);
    const Image here = draw_with(*renderer);
    std::jthread([&] {
      EXPECT_EQ(pixels_that_differ(renderer->render(camera()).volume, here), 0U);
      renderer.reset();
    }).join();
  }
}

TEST(Backends, RenderersWorkAtTheSameTimeInThreads) {
  for (const Backend kind : kKinds) {
    if (!has_backend(kind)) continue;
    GlRenderer renderer(kind);
    const Image expected = draw_with(renderer);
    std::array<std::size_t, 3> differing{};
    {
      std::vector<std::jthread> threads;
      threads.reserve(differing.size());
      for (std::size_t& count : differing) {
        threads.emplace_back([&count, &expected, kind] {
          GlRenderer own(kind);
          count = pixels_that_differ(draw_with(own), expected);
        });
      }
    }
    EXPECT_EQ(differing, (std::array<std::size_t, 3>{}));
  }
}

class GlUse : public GlTest {};

TEST_F(GlUse, AnUploadTakesThePlaceOfTheLast) {
  const Image first = draw(ring_in_ball(), camera());
  draw(nested_balls(5, 50.0, 6), camera());
  EXPECT_EQ(pixels_that_differ(draw(ring_in_ball(), camera()), first), 0U);
}

TEST_F(GlUse, CountsWhatItDraws) {
  const ShellSet set = ring_in_ball();
  draw(set, camera());
  const FrameStats& frame = renderer().last_frame();
  EXPECT_EQ(frame.passes, 1U);
  EXPECT_EQ(frame.draws, 2U);
  EXPECT_EQ(frame.triangles,
            set.shells[0].surface.triangles.size() + set.shells[1].surface.triangles.size());
  EXPECT_GT(frame.seconds, 0.0);
}

TEST_F(GlUse, RefusesToDrawWhatWasNotUploaded) {
  const ShellSet set = ring_in_ball();
  const Plan plan = make_plan(scene_facts(set), camera(), {});
  const std::array<std::uint32_t, 1> outer{0};
  renderer().upload(set, scene_facts(set), outer);
  EXPECT_THROW(renderer().render(camera(), plan), Error);
}

TEST_F(GlUse, RefusesShellsThatAreNotInTheSet) {
  const ShellSet set = ring_in_ball();
  const std::array<std::uint32_t, 1> third{2};
  EXPECT_THROW(renderer().upload(set, scene_facts(set), third), Error);
  SceneFacts wrong = scene_facts(set);
  wrong.shells[1].triangles += 1;
  const std::array<std::uint32_t, 1> second{1};
  EXPECT_THROW(renderer().upload(set, wrong, second), Error);
}

/// Opens EGL where it has no driver: exit status 4 if that is what the error says.
[[noreturn]] void open_egl_without_a_driver() {
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json", 1);
  try {
    open_backend(Backend::Egl);
  } catch (const Error& error) {
    std::exit(error.code() == ErrorCode::Unsupported ? 4 : 1);
  }
  std::exit(0);
}

TEST(BackendsDeathTest, SaysThatNoneWorks) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(open_egl_without_a_driver(), ::testing::ExitedWithCode(4), "");
}

}  // namespace
}  // namespace nacre::testing

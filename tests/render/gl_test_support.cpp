#include "tests/render/gl_test_support.h"

#include <array>
#include <cstdlib>
#include <glm/vec2.hpp>
#include <string>

#include "core/error.h"
#include "tests/support/ray_maximum.h"

namespace nacre::testing {
namespace {

const char* wanted_backend() { return std::getenv("NACRE_TEST_BACKEND"); }

}  // namespace

std::span<const glm::dvec2> offsets_nearby() {
  static constexpr double kNearby = 1.0 / 32.0;
  static constexpr std::array<glm::dvec2, 9> kOffsets{{{0, 0},
                                                       {kNearby, 0},
                                                       {-kNearby, 0},
                                                       {0, kNearby},
                                                       {0, -kNearby},
                                                       {kNearby, kNearby},
                                                       {kNearby, -kNearby},
                                                       {-kNearby, kNearby},
                                                       {-kNearby, -kNearby}}};
  return kOffsets;
}

Backend test_backend() {
  const char* wanted = wanted_backend();
  return wanted == nullptr ? Backend::Auto : backend(wanted).value();
}

bool has_backend(Backend backend) {
  try {
    return open_backend(backend).context != nullptr;
  } catch (const Error&) {
    const bool demanded = wanted_backend() != nullptr && name(backend) == wanted_backend();
    EXPECT_FALSE(demanded) << "NACRE_TEST_BACKEND names a backend that does not work here";
    return false;
  }
}

std::unique_ptr<GlRenderer> GlTest::shared_renderer;

void GlTest::SetUp() {
  if (shared_renderer != nullptr) return;
  try {
    shared_renderer = std::make_unique<GlRenderer>(test_backend());
  } catch (const Error& error) {
    ASSERT_EQ(wanted_backend(), nullptr) << error.what();
    GTEST_SKIP() << "no OpenGL on this machine: " << error.what();
  }
  RecordProperty("renderer", shared_renderer->info().renderer);
}

void GlTest::TearDownTestSuite() { shared_renderer.reset(); }

Image GlTest::draw(const ShellSet& set, const Camera& camera, const RenderOptions& options) {
  return draw_with({}, set, camera, options).volume;
}

Picture GlTest::draw_with(std::span<const Tool> tools, const ShellSet& set, const Camera& camera,
                          const RenderOptions& options) {
  shared_renderer->upload(set, {.normals = options.mode == PictureMode::Iso});
  shared_renderer->upload_tools(tools);
  return shared_renderer->render(camera, options);
}

void expect_matches_rays(const ShellSet& set, const Camera& camera, const Image& image,
                         const RayCheck& check) {
  ASSERT_EQ(image.width, camera.size.x);
  ASSERT_EQ(image.height, camera.size.y);
  const std::size_t count = image.pixels.size();
  std::size_t off_center = 0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < count; i += static_cast<std::size_t>(check.every)) {
    const int x = static_cast<int>(i) % image.width;
    const int y = static_cast<int>(i) / image.width;
    bool matches = false;
    for (const glm::dvec2& offset : offsets_nearby()) {
      const Ray ray = picture_ray(camera, x + 0.5 + offset.x, y + 0.5 + offset.y);
      const double truth = ray_maximum(set, ray, camera.perspective, check.hidden);
      matches = image.at(x, y) == static_cast<float>(truth);
      if (matches) break;
      if (offset == glm::dvec2(0.0)) ++off_center;
    }
    if (!matches && ++wrong <= 5) {
      ADD_FAILURE() << "pixel (" << x << ", " << y << ") shows " << image.at(x, y)
                    << ", which no ray near its centre does";
    }
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_LE(static_cast<double>(off_center),
            check.off_center * static_cast<double>(count) / check.every);
}

std::size_t pixels_that_differ(const Image& a, const Image& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i) {
    if (a.pixels[i] != b.pixels[i]) ++differing;
  }
  return differing;
}

}  // namespace nacre::testing

#pragma once

#include <gtest/gtest.h>

#include <glm/vec2.hpp>
#include <memory>
#include <span>

#include "core/camera.h"
#include "core/image.h"
#include "core/shell_set.h"
#include "core/tool.h"
#include "render/gl/gl_renderer.h"

namespace nacre::testing {

constexpr double kDegree = 0.017453292519943295;

/// What the tests draw with: NACRE_TEST_BACKEND (egl, osmesa), or whatever there is.
Backend test_backend();

/// Whether the machine has the backend at all. One named in NACRE_TEST_BACKEND has to be there.
bool has_backend(Backend backend);

/// Skips where there is no OpenGL to draw with; draws with one renderer all through a suite.
class GlTest : public ::testing::Test {
 protected:
  void SetUp() override;
  static void TearDownTestSuite();

  /// Uploads the set and draws the volume.
  static Image draw(const ShellSet& set, const Camera& camera, const RenderOptions& options = {});

  /// The same with tools: all that is seen.
  static Picture draw_with(std::span<const Tool> tools, const ShellSet& set, const Camera& camera,
                           const RenderOptions& options = {});

  static GlRenderer& renderer() { return *shared_renderer; }

 private:
  static std::unique_ptr<GlRenderer> shared_renderer;
};

/// How much of a picture to check against rays.
struct RayCheck {
  int hidden = -1;           ///< index of a shell that the picture leaves out
  int every = 1;             ///< checks one pixel in so many
  double off_center = 0.02;  ///< largest part of them that may differ from the ray through the
                             ///< pixel's very centre: silhouettes
};

/// Expects each pixel to be what a ray shows through its centre or, at a silhouette, through a
/// point within 1/32 of a pixel (rasterisers round corners to 1/256).
void expect_matches_rays(const ShellSet& set, const Camera& camera, const Image& image,
                         const RayCheck& check = {});

/// Offsets from a pixel's centre by up to 1/32 pixel, none first.
std::span<const glm::dvec2> offsets_nearby();

/// Number of pixels in which two pictures of one size differ.
std::size_t pixels_that_differ(const Image& a, const Image& b);

}  // namespace nacre::testing

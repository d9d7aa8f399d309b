// What lies beyond the box of a set's volume, where caps lie on the set's grid, is not shown there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <glm/ext/matrix_transform.hpp>
#include <vector>

#include "reference/exact_picture.h"
#include "reference/exact_walk.h"
#include "reference/shell_picture.h"
#include "tests/render/cpu_test_support.h"
#include "tests/render/gl_test_support.h"
#include "tests/support/nested_shells.h"
#include "tests/support/test_volumes.h"

namespace nacre::testing {
namespace {

/// An oblique volume that is bright throughout.
Volume bright() {
  Volume volume = volume_of<std::uint8_t>({9, 7, 5}, [](auto, auto, auto) { return 1; });
  volume.world_from_voxel =
      glm::rotate(glm::translate(glm::dmat4(1.0), {300.0, -20.0, 5.0}), 0.2, {1.0, 2.0, 3.0});
  return volume;
}

/// Its shell as a coarse grid would have it: a third of a voxel beyond the border.
ShellSet shell_beyond(const Volume& volume) {
  TriangleMesh mesh = block_mesh({-0.33, -0.33, -0.33}, {8.33, 6.33, 4.33});
  ShellSet set;
  set.volume.dims = volume.dims;
  set.volume.world_from_voxel = volume.world_from_voxel;
  set.center_mm = bounding_sphere(volume.dims, volume.world_from_voxel).center_mm;
  for (glm::vec3& p : mesh.positions) {
    p = glm::vec3(glm::dvec3(volume.world_from_voxel * glm::dvec4(p, 1.0)) - set.center_mm);
  }
  set.shells.push_back({1.0, 1.0, 1.0, std::move(mesh)});
  return set;
}

/// The way of rays through the volume, mm: renderers round places to parts of a pixel, and may miss
/// what is shorter than this.
constexpr float kTie = 0.01F;

void expect_same(const Image& drawn, const Image& exact, const Image& way_mm) {
  for (int y = 0; y < exact.height; ++y) {
    for (int x = 0; x < exact.width; ++x) {
      const bool is_tie = way_mm.at(x, y) > 0.0F && way_mm.at(x, y) < kTie;
      if (is_tie) continue;
      EXPECT_EQ(drawn.at(x, y), exact.at(x, y)) << x << ", " << y;
    }
  }
}

class Border : public ::testing::TestWithParam<bool> {
 protected:
  /// By OpenGL, or on the processor.
  Picture draw_set(const ShellSet& set, const Camera& camera, const RenderOptions& options,
                   std::span<const Tool> tools = {}) {
    if (!GetParam()) return draw(set, tools, camera, options);
    GlRenderer renderer(test_backend());
    renderer.upload(set);
    renderer.upload_tools(tools);
    return renderer.render(camera, options);
  }

  bool is_skipped() const { return GetParam() && !has_backend(test_backend()); }

  const Volume volume_ = bright();
  const ExactWalk walk_{volume_, EmissionMap::window(0, 1)};
  const ShellSet set_ = shell_beyond(volume_);
  const BoundingSphere sphere_ = bounding_sphere(volume_.dims, volume_.world_from_voxel);
};

// Pixels beside the box are black, and those within as bright as the volume.
TEST_P(Border, PicturesEndWhereTheVolumeDoes) {
  if (is_skipped()) GTEST_SKIP() << "no OpenGL on this machine";
  for (const Camera& camera : cameras(sphere_, {81, 60})) {
    const Image way_mm = exact_picture(walk_, camera, {.mode = PictureMode::Sum}).volume;
    for (const Layers layers : {Layers::Flat, Layers::Smooth, Layers::Fine}) {
      const Picture max = draw_set(set_, camera, {.layers = layers});
      expect_same(max.volume, exact_picture(walk_, camera).volume, way_mm);
    }
    const Image sum = draw_set(set_, camera, {.mode = PictureMode::Sum}).volume;
    for (std::size_t i = 0; i < way_mm.pixels.size(); ++i) {
      ASSERT_NEAR(sum.pixels[i], way_mm.pixels[i], kTie) << i;
      ASSERT_FALSE(way_mm.pixels[i] == 0.0F && sum.pixels[i] != 0.0F) << i;
    }
  }
}

TEST_P(Border, CertifiedPicturesAreTheDrawnOnes) {
  if (is_skipped()) GTEST_SKIP() << "no OpenGL on this machine";
  for (const Camera& camera : cameras(sphere_, {81, 60})) {
    const Image way_mm = exact_picture(walk_, camera, {.mode = PictureMode::Sum}).volume;
    for (const PictureMode mode : {PictureMode::Max, PictureMode::Count}) {
      const Image drawn = draw_set(set_, camera, {.mode = mode}).volume;
      expect_same(drawn, shell_picture(set_, camera, {.mode = mode}).volume, way_mm);
    }
  }
}

TEST_P(Border, ToolsAreSeenBeyond) {
  if (is_skipped()) GTEST_SKIP() << "no OpenGL on this machine";
  ShellSet nowhere = set_;
  nowhere.volume = {};
  const Camera camera = cameras(sphere_, {81, 60}).front();
  for (const std::vector<Tool>& tools : tools_about(sphere_, camera)) {
    const Picture with = draw_set(set_, camera, {}, tools);
    const Picture without = draw_set(nowhere, camera, {}, tools);
    ASSERT_TRUE(with.tools && without.tools);
    EXPECT_EQ(with.tools->colors, without.tools->colors);
    EXPECT_EQ(with.tools->covered, without.tools->covered);
    EXPECT_NE(with.volume.pixels, without.volume.pixels) << "without a volume it is not clipped";
  }
}

TEST(BorderPlan, SaysWhichColumnsShow) {
  const Volume volume = bright();
  SceneFacts facts = scene_facts(shell_beyond(volume));
  const Camera camera = camera_of(volume, {.size = {40, 30}});
  EXPECT_EQ(make_plan(facts, camera, {}).columns.size(), 30U);
  EXPECT_TRUE(make_plan(facts, camera, {.mode = PictureMode::Iso}).columns.empty());
  facts.volume.world_from_voxel[2] = glm::dvec4(0.0);  // no inside: nothing to cut at
  EXPECT_TRUE(make_plan(facts, camera, {}).columns.empty());
  facts.volume = {};
  EXPECT_TRUE(make_plan(facts, camera, {}).columns.empty());
}

INSTANTIATE_TEST_SUITE_P(Renderers, Border, ::testing::Values(false, true),
                         [](const auto& drawn) { return drawn.param ? "OpenGl" : "Processor"; });

}  // namespace
}  // namespace nacre::testing

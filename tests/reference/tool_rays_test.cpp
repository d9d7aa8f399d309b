#include "reference/tool_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/support/nested_shells.h"

namespace nacre {
namespace {

using testing::ball_mesh;
using testing::block_mesh;

const BoundingSphere kSphere{{10, 20, 30}, 10.0};

Tool tool_of(TriangleMesh mesh, const glm::vec3& color = {1, 0.5, 0.25}) {
  Tool tool;
  tool.mesh = std::move(mesh);
  tool.color = color;
  return tool;
}

/// One face, turned away from -y: wound either way.
TriangleMesh face(bool turned) {
  TriangleMesh mesh{{{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}}, {{0, 1, 2}}};
  if (turned) mesh.triangles[0] = {0, 2, 1};
  return mesh;
}

TEST(ToolRays, AToolIsWhereItsPosePutsIt) {
  Tool tool = tool_of(block_mesh({-1, -1, -1}, {1, 1, 1}));
  // Twice as large, x to y, moved.
  tool.world_from_tool = {{0, 2, 0, 0}, {-2, 0, 0, 0}, {0, 0, 2, 0}, {10, 20, 30, 1}};
  const ToolRays rays({&tool, 1});
  const auto hit = rays.nearest({{10.5, 0, 30.25}, {0, 1, 0}});
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->t_mm, 18.0);
  EXPECT_EQ(hit->tool, 0u);
  EXPECT_NEAR(std::abs(glm::dot(hit->normal, glm::dvec3(0, 1, 0))), 1.0, 1e-15);
  EXPECT_FALSE(rays.nearest({{13, 0, 30}, {0, 1, 0}}));
  EXPECT_FALSE(rays.nearest({{10.5, 0, 30.25}, {0, 1, 0}}, {0.0, 17.0}));
}

TEST(ToolRays, TheNearestOfSeveralToolsIsNamed) {
  const std::vector<Tool> tools{tool_of(block_mesh({5, 0, 0}, {6, 1, 1})), tool_of({}),
                                tool_of(block_mesh({2, 0, 0}, {3, 1, 1})),
                                tool_of(block_mesh({2, 0, 0}, {3, 1, 1}))};
  const ToolRays rays(tools);
  const Ray ray{{0, 0.25, 0.5}, {1, 0, 0}};
  EXPECT_EQ(rays.nearest(ray)->tool, 2u);
  EXPECT_EQ(rays.nearest(ray, {3.5, 9.0})->tool, 0u);
  EXPECT_TRUE(ToolRays({}).empty());
  EXPECT_FALSE(ToolRays({}).nearest(ray));
}

TEST(ToolRays, BothSidesShineWithTheCosineOfTheFlatFace) {
  const Camera camera = make_camera({.size = {4, 4}}, kSphere);
  for (const bool turned : {false, true}) {
    Tool tool = tool_of(face(turned));
    const double angle = 0.7;
    tool.world_from_tool = {{std::cos(angle), std::sin(angle), 0, 0},
                            {-std::sin(angle), std::cos(angle), 0, 0},
                            {0, 0, 1, 0},
                            {10, 20, 30, 1}};
    const ToolRays rays({&tool, 1});
    const Ray ray{{10, 0, 30}, {0, 1, 0}};
    const auto hit = rays.nearest(ray);
    ASSERT_TRUE(hit);
    const glm::vec3 color = lit_tool(rays, camera, {}, ray, *hit);
    const double light = 0.2 + 0.8 * std::cos(angle);
    EXPECT_NEAR(color.x, light, 1e-6);
    EXPECT_NEAR(color.z, 0.25 * light, 1e-6);
  }
}

TEST(ToolRays, TheCueStopsAtTheVolumesSphere) {
  const Camera camera = make_camera({.size = {4, 4}}, kSphere);  // looks along +y
  const DepthCue cue{0.5, 0.1, 0.2};
  struct Expected {
    double y;
    double beta;
  };
  for (const auto& [y, expected] : {Expected{5, 0.8}, Expected{10, 0.8}, Expected{20, 0.55},
                                    Expected{25, 0.425}, Expected{30, 0.3}, Expected{90, 0.3}}) {
    Tool tool = tool_of(face(false), {1, 1, 1});
    tool.world_from_tool[3] = {10, y, 30, 1};
    const ToolRays rays({&tool, 1});
    const Ray ray{{10, 0, 30}, {0, 1, 0}};
    EXPECT_NEAR(lit_tool(rays, camera, cue, ray, *rays.nearest(ray)).x, expected, 1e-6) << y;
  }
}

TEST(ToolRays, APixelHoldsWhatIsInFrontOfTheEye) {
  const Tool behind_and_ahead[] = {tool_of(block_mesh({5, -60, 25}, {15, -50, 35}), {1, 0, 0}),
                                   tool_of(block_mesh({5, 25, 25}, {15, 26, 35}), {0, 1, 0})};
  const ToolRays rays(behind_and_ahead);
  const Camera camera =
      make_camera({.size = {3, 3}, .field_of_view_rad = 0.5, .distance_mm = 40.0}, kSphere);
  ToolLayer layer = make_tool_layer(3, 3);
  const double t = draw_tool_pixel(rays, camera, {}, picture_ray(camera, 1.5, 1.5), 1, 1, layer);
  EXPECT_NEAR(t, 45.0, 1e-12);
  EXPECT_EQ(layer.covered[4], 1);
  EXPECT_NEAR(layer.colors[4].y, 1.0, 1e-6);
  EXPECT_EQ(layer.colors[4].x, 0.0f);

  // Orthographic cameras have no eye: the line begins infinitely far away.
  const Camera flat = make_camera({.size = {3, 3}}, kSphere);
  draw_tool_pixel(rays, flat, {}, picture_ray(flat, 1.5, 1.5), 1, 1, layer);
  EXPECT_NEAR(layer.colors[4].x, 1.0, 1e-6);
  EXPECT_TRUE(
      std::isinf(draw_tool_pixel(rays, flat, {}, picture_ray(flat, 40.0, 1.5), 0, 0, layer)));
  EXPECT_EQ(layer.covered[0], 0);
}

}  // namespace
}  // namespace nacre

// Which pixels a triangle covers, in both ways of drawing one.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <random>
#include <vector>

#include "render/cpu/cluster_kernel.h"
#include "render/cpu/large_triangles.h"

namespace nacre::testing {
namespace {

constexpr int kSide = 32;

/// Pixels as positions: (x, y, 0) is the point x to the right of the picture's left edge and y
/// below its upper one.
ClusterProjection pixels_as_positions() {
  ClusterProjection projection;
  projection.row_x = {2.0F / kSide, 0.0F, 0.0F, -1.0F};
  projection.row_y = {0.0F, 2.0F / kSide, 0.0F, -1.0F};
  projection.row_w = {0.0F, 0.0F, 0.0F, 1.0F};
  projection.view_from = {0.0F, 0.0F, 1.0F};
  return projection;
}

using Corners = std::array<glm::vec2, 3>;

MeshClusters clusters_of(const Corners& corners) {
  TriangleMesh mesh;
  for (const glm::vec2& corner : corners) mesh.positions.emplace_back(corner, 0.0F);
  mesh.triangles.emplace_back(0U, 1U, 2U);
  return cluster_mesh(mesh);
}

enum class Way { Baseline, Best, Large };
constexpr std::array<Way, 3> kWays{Way::Baseline, Way::Best, Way::Large};

std::vector<std::uint8_t> covered(const Corners& corners, Way way, Faces faces = Faces::Both) {
  const MeshClusters mesh = clusters_of(corners);
  std::vector<std::uint8_t> pixels(kSide * kSide, 0);
  const PixelTarget<std::uint8_t> target{pixels.data(), kSide, kSide};
  const ClusterDraw<std::uint8_t> draw{mesh.clusters.data(), 1,     mesh.positions.data(),
                                       mesh.corners.data(),  faces, {1}};
  std::array<std::uint32_t, 1> too_large{};
  if (way == Way::Large) {
    draw_large_cluster(draw, pixels_as_positions(), target);
  } else {
    const InstructionSet set = way == Way::Best ? best_instruction_set() : InstructionSet::Baseline;
    const KernelResult result =
        draw_clusters_for<std::uint8_t>(set)(draw, pixels_as_positions(), target, too_large.data());
    EXPECT_EQ(result.too_large, 0U);
  }
  return pixels;
}

/// A corner anywhere, on a pixel's centre, or on a pixel's corner: where ties are.
glm::vec2 random_corner(std::mt19937& random) {
  std::uniform_int_distribution<int> whole(-3, kSide + 2);
  std::uniform_int_distribution<int> fraction(0, 255);
  const int kind = std::uniform_int_distribution<int>(0, 2)(random);
  const auto coordinate = [&] {
    const float part =
        kind == 0 ? static_cast<float>(fraction(random)) / 256.0F : (kind == 1 ? 0.5F : 0.0F);
    return static_cast<float>(whole(random)) + part;
  };
  const float x = coordinate();
  return {x, coordinate()};
}

TEST(CpuCoverage, BothWaysAndAllInstructionsCoverTheSame) {
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    const Corners corners{random_corner(random), random_corner(random), random_corner(random)};
    const auto expected = covered(corners, Way::Baseline);
    ASSERT_EQ(covered(corners, Way::Best), expected);
    ASSERT_EQ(covered(corners, Way::Large), expected);
  }
}

// The three triangles around a point within a triangle cover each of its pixels exactly once.
TEST(CpuCoverage, TrianglesThatShareEdgesCoverEachPixelOnce) {
  std::mt19937 random(2);
  for (const Way way : kWays) {
    for (int i = 0; i < 200; ++i) {
      const glm::vec2 a = random_corner(random);
      const glm::vec2 b = random_corner(random);
      const glm::vec2 c = random_corner(random);
      // On the grid of sub-pixels, so that nothing is rounded.
      const glm::vec2 middle = glm::vec2(glm::ivec2((a + b + c) * (256.0F / 3.0F))) / 256.0F;
      const auto whole = covered({a, b, c}, way);
      const auto one = covered({a, b, middle}, way);
      const auto two = covered({b, c, middle}, way);
      const auto three = covered({c, a, middle}, way);
      for (std::size_t p = 0; p < whole.size(); ++p) {
        const int parts = one[p] + two[p] + three[p];
        // Rounding the middle may turn a part of a sliver over.
        if (parts != whole[p]) {
          const auto area = [](glm::vec2 u, glm::vec2 v, glm::vec2 w) {
            return (v.x - u.x) * (w.y - u.y) - (v.y - u.y) * (w.x - u.x);
          };
          const bool turned = area(a, b, c) * area(a, b, middle) <= 0.0F ||
                              area(a, b, c) * area(b, c, middle) <= 0.0F ||
                              area(a, b, c) * area(c, a, middle) <= 0.0F;
          ASSERT_TRUE(turned) << "pixel " << p % kSide << ", " << p / kSide;
        }
      }
    }
  }
}

// Upper and left edges through centres are covered, lower and right ones are not.
TEST(CpuCoverage, ASquareBetweenCentresCoversItsUpperAndLeftRow) {
  for (const Way way : kWays) {
    const auto upper = covered({glm::vec2(2.5F, 3.5F), {6.5F, 3.5F}, {2.5F, 7.5F}}, way);
    const auto lower = covered({glm::vec2(6.5F, 3.5F), {6.5F, 7.5F}, {2.5F, 7.5F}}, way);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const auto p = static_cast<std::size_t>(x + kSide * y);
        const bool inside = x >= 2 && x < 6 && y >= 3 && y < 7;
        EXPECT_EQ(upper[p] + lower[p], inside ? 1 : 0) << x << ", " << y;
      }
    }
  }
}

TEST(CpuCoverage, FacesAreToldApart) {
  // Counter-clockwise as seen in the picture, and the other way.
  const Corners front{glm::vec2(4.0F, 20.0F), {20.0F, 20.0F}, {4.0F, 4.0F}};
  const Corners back{front[0], front[2], front[1]};
  const std::vector<std::uint8_t> nothing(kSide * kSide, 0);
  for (const Way way : kWays) {
    EXPECT_NE(covered(front, way, Faces::Front), nothing);
    EXPECT_EQ(covered(front, way, Faces::Back), nothing);
    EXPECT_EQ(covered(back, way, Faces::Front), nothing);
    EXPECT_EQ(covered(back, way, Faces::Back), covered(front, way, Faces::Front));
  }
}

TEST(CpuCoverage, TrianglesWithoutAreaCoverNothing) {
  const std::vector<std::uint8_t> nothing(kSide * kSide, 0);
  for (const Way way : kWays) {
    EXPECT_EQ(covered({glm::vec2(4.5F, 4.5F), {4.5F, 4.5F}, {9.5F, 9.5F}}, way), nothing);
    EXPECT_EQ(covered({glm::vec2(4.5F, 4.5F), {6.5F, 6.5F}, {9.5F, 9.5F}}, way), nothing);
  }
}

}  // namespace
}  // namespace nacre::testing

// Which pixels a triangle covers, in both ways of drawing one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
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

MeshClusters clusters_of(const Corners& corners, const glm::vec3& depths = {}) {
  TriangleMesh mesh;
  for (int i = 0; i < 3; ++i) {
    mesh.positions.emplace_back(corners[static_cast<std::size_t>(i)], depths[i]);
  }
  mesh.triangles.emplace_back(0U, 1U, 2U);
  return cluster_mesh(mesh);
}

enum class Way { Baseline, Avx2, Avx512, Large };
constexpr std::array<Way, 4> kWays{Way::Baseline, Way::Avx2, Way::Avx512, Way::Large};
constexpr std::array<Way, 2> kWideWays{Way::Avx2, Way::Avx512};

/// The instruction set of a way that has one; the baseline where this processor lacks it.
InstructionSet instructions_of(Way way) {
  const InstructionSet set = way == Way::Avx512 ? InstructionSet::Avx512 : InstructionSet::Avx2;
  return way != Way::Baseline && has_instruction_set(set) ? set : InstructionSet::Baseline;
}

/// Draws a triangle of a rank over pixels.
void draw_over(std::vector<std::uint8_t>& pixels, const Corners& corners, std::uint8_t rank,
               Way way, Faces faces = Faces::Both) {
  const MeshClusters mesh = clusters_of(corners);
  pixels.resize(kSide * kSide + kPixelPadding);
  const PixelTarget<std::uint8_t> target{pixels.data(), kSide, kSide};
  const ClusterDraw<std::uint8_t> draw{mesh.clusters.data(), 1,     mesh.positions.data(),
                                       mesh.corners.data(),  faces, {rank}};
  std::array<std::uint32_t, 1> too_large{};
  if (way == Way::Large) {
    draw_large_cluster(draw, pixels_as_positions(), target);
  } else {
    const InstructionSet set = instructions_of(way);
    const KernelResult result =
        draw_clusters_for<std::uint8_t>(set)(draw, pixels_as_positions(), target, too_large.data());
    EXPECT_EQ(result.too_large, 0U);
  }
  pixels.resize(kSide * kSide);
}

std::vector<std::uint8_t> covered(const Corners& corners, Way way, Faces faces = Faces::Both) {
  std::vector<std::uint8_t> pixels(kSide * kSide, 0);
  draw_over(pixels, corners, 1, way, faces);
  return pixels;
}

/// What a cut triangle leaves in pixels. Depth is z, rays end at `ends_mm`.
template <class Pixel>
std::vector<Pixel> left_of(const MeshClusters& mesh, Way way, const Brightness<Pixel>& brightness,
                           const RayEnds* ends) {
  ClusterProjection projection = pixels_as_positions();
  projection.row_depth = {0.0F, 0.0F, 1.0F, 0.0F};
  projection.z_of_depth = {1.0F, -0.1F};
  std::vector<Pixel> pixels(kSide * kSide + kPixelPadding, 0);
  const PixelTarget<Pixel> target{pixels.data(), kSide, kSide};
  const ClusterDraw<Pixel> draw{
      mesh.clusters.data(), 1,   mesh.positions.data(), mesh.corners.data(), Faces::Both,
      brightness,           ends};
  std::array<std::uint32_t, 1> too_large{};
  if (way == Way::Large) {
    draw_large_cluster(draw, projection, target);
  } else {
    const InstructionSet set = instructions_of(way);
    draw_clusters_for<Pixel>(set)(draw, projection, target, too_large.data());
  }
  pixels.resize(kSide * kSide);
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
    for (const Way vectors : kWideWays) ASSERT_EQ(covered(corners, vectors), expected);
    ASSERT_EQ(covered(corners, Way::Large), expected);
  }
}

// Rays end at a depth of their own in each pixel; triangles are tilted and lie partly before the
// start, between, and beyond.
TEST(CpuCoverage, BothWaysAndAllInstructionsCutTheSame) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> depth(-4.0F, 12.0F);
  std::vector<float> ends_mm(kSide * kSide);
  std::size_t ranks = 0;
  std::size_t counted = 0;
  for (int i = 0; i < 300; ++i) {
    for (float& end : ends_mm) end = depth(random);
    const auto [least, greatest] = std::minmax_element(ends_mm.begin(), ends_mm.end());
    const RayEnds ends{ends_mm.data(), *least, *greatest};
    const Corners corners{random_corner(random), random_corner(random), random_corner(random)};
    const MeshClusters mesh = clusters_of(corners, {depth(random), depth(random), depth(random)});
    const auto keys = left_of<std::uint64_t>(mesh, Way::Baseline, {7}, nullptr);
    const auto rank = left_of<std::uint8_t>(mesh, Way::Baseline, {3}, &ends);
    const auto cued = left_of<float>(mesh, Way::Baseline, {1.0F, 0.5F}, &ends);
    const auto count = left_of<std::int32_t>(mesh, Way::Baseline, {}, &ends);
    const Brightness<std::int64_t> integral{0.0F, 1000.0F, 30.0F, 100.0F, true};
    const auto sum = left_of<std::int64_t>(mesh, Way::Baseline, integral, &ends);
    const auto sum_large = left_of<std::int64_t>(mesh, Way::Large, integral, &ends);
    for (const Way vectors : kWideWays)
      ASSERT_EQ(left_of<std::int64_t>(mesh, vectors, integral, &ends), sum);
    const auto crossings = left_of<std::int64_t>(mesh, Way::Baseline, {5.0F}, &ends);
    for (const Way way : {Way::Avx2, Way::Avx512, Way::Large}) {
      ASSERT_EQ(left_of<std::int64_t>(mesh, way, {5.0F}, &ends), crossings);
      ASSERT_EQ(left_of<std::uint8_t>(mesh, way, {3}, &ends), rank);
      ASSERT_EQ(left_of<std::int32_t>(mesh, way, {}, &ends), count);
    }
    for (const Way vectors : kWideWays)
      ASSERT_EQ(left_of<float>(mesh, vectors, {1.0F, 0.5F}, &ends), cued);
    for (const Way vectors : kWideWays)
      ASSERT_EQ(left_of<std::uint64_t>(mesh, vectors, {7}, nullptr), keys);
    const auto cued_large = left_of<float>(mesh, Way::Large, {1.0F, 0.5F}, &ends);
    const auto keys_large = left_of<std::uint64_t>(mesh, Way::Large, {7}, nullptr);
    for (std::size_t p = 0; p < keys.size(); ++p) {
      ASSERT_NEAR(cued_large[p], cued[p], 1e-5F);
      ASSERT_EQ(keys[p] == 0, keys_large[p] == 0);
      if (keys[p] == 0) continue;
      const NearestKey seen = nearest_of(keys[p]);
      EXPECT_EQ(seen.triangle, 7U);
      ASSERT_NEAR(nearest_of(keys_large[p]).depth_mm, seen.depth_mm, 1e-4F);
      const bool between = seen.depth_mm >= 0.0F && seen.depth_mm <= ends_mm[p];
      ASSERT_EQ(rank[p], between ? 3 : 0);
      ASSERT_EQ(count[p] != 0, seen.depth_mm > ends_mm[p]);
      ASSERT_EQ(crossings[p], between ? 5 : 0);
      const double d = std::clamp<double>(seen.depth_mm, 0.0, std::max(ends_mm[p], 0.0F));
      ASSERT_NEAR(std::abs(static_cast<double>(sum[p])), d * (1000.0 + 30.0 * d), 1.5);
      ASSERT_NEAR(static_cast<double>(sum_large[p]), static_cast<double>(sum[p]), 1.5);
      ranks += rank[p] != 0 ? 1U : 0U;
      counted += count[p] != 0 ? 1U : 0U;
    }
  }
  EXPECT_GT(ranks, 1000U);
  EXPECT_GT(counted, 1000U);
}

// Kernels pass over what cannot raise a pixel, many pixels at once: pixels as bright as the
// triangle or brighter, with darker ones here and there.
TEST(CpuCoverage, EveryPixelHoldsTheBrighterOfBoth) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> any(0, 255);
  std::vector<std::uint8_t> before(kSide * kSide);
  std::size_t raised = 0;
  for (int i = 0; i < 4000; ++i) {
    const int rank =
        std::array{1, 2, 100, 127, 128, 129, 254, 255}[static_cast<std::size_t>(i % 8)];
    const int dark_one_in = 1 + i % 50;
    for (std::uint8_t& pixel : before) {
      const bool dark = any(random) % dark_one_in == 0;
      pixel =
          static_cast<std::uint8_t>(dark ? any(random) % rank : rank + any(random) % (256 - rank));
    }
    const glm::vec2 corner = random_corner(random);
    const auto near = [&](float reach) {
      return corner + reach * (random_corner(random) - corner) / static_cast<float>(kSide);
    };
    const float reach = i % 3 == 0 ? 2.0F : 8.0F;
    const Corners corners{corner, near(reach), near(reach)};
    const std::vector<std::uint8_t> is_covered = covered(corners, Way::Large);
    std::vector<std::uint8_t> expected = before;
    for (std::size_t at = 0; at < expected.size(); ++at) {
      if (is_covered[at] == 0 || expected[at] >= rank) continue;
      expected[at] = static_cast<std::uint8_t>(rank);
      ++raised;
    }
    for (const Way way : kWays) {
      std::vector<std::uint8_t> pixels = before;
      draw_over(pixels, corners, static_cast<std::uint8_t>(rank), way);
      ASSERT_EQ(pixels, expected) << "triangle " << i << " of rank " << rank;
    }
  }
  EXPECT_GT(raised, 1000U);
}

/// The depth of a triangle's plane at a point, in double.
double plane_depth(const Corners& corners, const glm::dvec3& depths, const glm::dvec2& at) {
  const glm::dvec3 a(corners[0], depths[0]);
  const glm::dvec3 normal =
      glm::cross(glm::dvec3(corners[1], depths[1]) - a, glm::dvec3(corners[2], depths[2]) - a);
  return a.z - glm::dot(glm::dvec2(normal), at - glm::dvec2(a)) / normal.z;
}

// Corners in a line, which rounding makes triangles of: their depths stay, both ways.
TEST(CpuCoverage, SumsLeaveTheDepthsOfTrianglesWithoutArea) {
  std::mt19937 random(6);
  std::uniform_int_distribution<int> fine(0, 16 * 4096);  // so that differences are exact
  const auto vector = [&] {
    const auto x = static_cast<float>(fine(random)) / 4096.0F;
    return glm::vec2(x, static_cast<float>(fine(random)) / 4096.0F);
  };
  std::uniform_real_distribution<float> depth(10.0F, 90.0F);
  constexpr float kSteps = 1e6F;
  const Brightness<std::int64_t> integral{0.0F, kSteps, 0.0F, 100.0F, true};
  std::size_t covered = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::vec2 from = vector();
    const glm::vec2 way = 0.5F * vector();
    const Corners corners{from, from + 2.0F * way, from + way};
    const MeshClusters mesh = clusters_of(corners, {depth(random), depth(random), depth(random)});
    const auto sum = left_of<std::int64_t>(mesh, Way::Baseline, integral, nullptr);
    const auto large = left_of<std::int64_t>(mesh, Way::Large, integral, nullptr);
    for (const Way vectors : kWideWays)
      ASSERT_EQ(left_of<std::int64_t>(mesh, vectors, integral, nullptr), sum);
    for (std::size_t p = 0; p < sum.size(); ++p) {
      ASSERT_NEAR(static_cast<double>(sum[p]), static_cast<double>(large[p]), 2e-4 * kSteps);
      covered += sum[p] != 0 ? 1U : 0U;
    }
  }
  EXPECT_GT(covered, 100U);
}

// Corners are rounded to 1/256 of a pixel, depths of sums are not: the plane stays where it is. A
// sliver's depth stays near those of its corners.
TEST(CpuCoverage, SumsTakeTheDepthOfTheTriangleAsItWas) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> place(0.0F, kSide);
  std::uniform_real_distribution<float> depth(10.0F, 90.0F);
  std::uniform_real_distribution<float> wide(0.0F, 0.01F);
  constexpr float kSteps = 1e6F;
  const Brightness<std::int64_t> integral{0.0F, kSteps, 0.0F, 100.0F, true};
  std::size_t on_plane = 0;
  std::size_t slivers = 0;
  for (int i = 0; i < 10000; ++i) {
    Corners corners{glm::vec2(place(random), place(random)), {place(random), place(random)}, {}};
    const bool sliver = i % 2 == 0;
    corners[2] = sliver ? 0.5F * (corners[0] + corners[1]) + glm::vec2(wide(random), wide(random))
                        : glm::vec2(place(random), place(random));
    const glm::vec3 depths(depth(random), depth(random), depth(random));
    const MeshClusters mesh = clusters_of(corners, depths);
    const auto sum = left_of<std::int64_t>(mesh, Way::Baseline, integral, nullptr);
    for (const Way vectors : kWideWays)
      ASSERT_EQ(left_of<std::int64_t>(mesh, vectors, integral, nullptr), sum);
    const auto large = left_of<std::int64_t>(mesh, Way::Large, integral, nullptr);
    const auto [least, greatest] = std::minmax({depths[0], depths[1], depths[2]});
    const float beyond = 0.26F * (greatest - least);
    const glm::dvec2 u(corners[1] - corners[0]);
    const glm::dvec2 v(corners[2] - corners[0]);
    const bool fat = std::abs(u.x * v.y - u.y * v.x) > 8.0 * kSide;
    for (std::size_t p = 0; p < sum.size(); ++p) {
      if (sum[p] == 0) continue;
      const double crossing = std::abs(static_cast<double>(sum[p])) / kSteps;
      ASSERT_GE(crossing, least - beyond);
      ASSERT_LE(crossing, greatest + beyond);
      slivers += sliver ? 1U : 0U;
      if (!fat) continue;
      const glm::dvec2 center(static_cast<double>(p % kSide) + 0.5,
                              static_cast<double>(p / kSide) + 0.5);
      ASSERT_NEAR(crossing, plane_depth(corners, depths, center), 2e-4);
      ASSERT_NEAR(std::abs(static_cast<double>(large[p])) / kSteps, crossing, 2e-4);
      ++on_plane;
    }
  }
  EXPECT_GT(on_plane, 10000U);
  EXPECT_GT(slivers, 100U);
}

TEST(CpuCoverage, NearerTrianglesHaveGreaterKeys) {
  const std::array<float, 7> depths{-1e30F, -2.0F, -1e-20F, 0.0F, 1e-20F, 3.0F, 1e30F};
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const NearestKey back = nearest_of(key_of({depths[i], 12}));
    EXPECT_EQ(back.depth_mm, depths[i]);
    EXPECT_EQ(back.triangle, 12U);
    EXPECT_GT(key_of({depths[i], 11}), key_of({depths[i], 12}));
    if (i == 0) continue;
    EXPECT_GT(key_of({depths[i - 1], 99}), key_of({depths[i], 0}));
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

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

#include "render/cpu/cpu_renderer.h"
#include "render/cpu/detail_levels.h"
#include "render/cpu/edge_merging.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {
namespace {

/// Distances are floats of numbers up to 100.
constexpr double kRounding = 1e-5;

/// How often each edge is run along, less how often it is run along the other way.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> unbalanced_edges(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t from = t[i];
      const std::uint32_t to = t[(i + 1) % 3];
      balance[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  for (auto edge = balance.begin(); edge != balance.end();) {
    edge = edge->second == 0 ? balance.erase(edge) : std::next(edge);
  }
  return balance;
}

double enclosed_volume(const TriangleMesh& mesh) {
  double six_times = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]);
    const glm::dvec3 b(mesh.positions[t.y]);
    six_times += glm::dot(glm::cross(a, b), glm::dvec3(mesh.positions[t.z]));
  }
  return six_times / 6.0;
}

std::vector<glm::vec3> vertices_of(const MeshClusters& mesh) {
  std::vector<glm::vec3> vertices;
  for (const Cluster& cluster : mesh.clusters) {
    const float* x = mesh.positions.data() + cluster.first_position;
    for (std::size_t i = 0; i < cluster.vertices; ++i) {
      const std::size_t count = cluster.vertices;
      vertices.emplace_back(x[i], x[i + count], x[i + 2 * count]);
    }
  }
  return vertices;
}

TEST(EdgeMerging, LeavesWhatIsClosedClosed) {
  EdgeMerging merging(two_rings());
  std::size_t triangles = merging.mesh().triangles.size();
  double reach_mm = 0.3;
  while (triangles > 20) {
    ASSERT_LT(reach_mm, 100.0);
    merging.merge_pairs(reach_mm);
    EXPECT_TRUE(unbalanced_edges(merging.mesh()).empty()) << reach_mm;
    EXPECT_LE(merging.mesh().triangles.size(), triangles);
    triangles = merging.mesh().triangles.size();
    reach_mm *= 1.5;
  }
}

TEST(EdgeMerging, MovesNoVertexBeyondTheReach) {
  EdgeMerging merging(two_rings());
  double reach_mm = 0.3;
  for (int i = 0; i < 12; ++i) {
    merging.merge_pairs(reach_mm);
    EXPECT_LE(merging.farthest_mm(), reach_mm + kRounding);
    reach_mm *= 1.5;
  }
  EXPECT_GT(merging.farthest_mm(), 5.0);
}

TEST(EdgeMerging, MergesNothingOutOfReach) {
  EdgeMerging merging(block_mesh({0, 0, 0}, {10, 10, 10}));
  merging.merge_pairs(4.9);  // to the middle of an edge it is 5
  EXPECT_EQ(merging.mesh().positions.size(), 8U);
  EXPECT_EQ(merging.farthest_mm(), 0.0);
}

TEST(EdgeMerging, LeavesCornersThatItCannotReplace) {
  EdgeMerging merging(block_mesh({0, 0, 0}, {10, 10, 10}));
  merging.merge_pairs(9.0);
  EXPECT_EQ(merging.mesh().triangles.size(), 12U);
}

TEST(EdgeMerging, StaysNearACurvedSurface) {
  EdgeMerging merging(ball_mesh({}, 50.0, 120));
  for (const double reach_mm : {1.0, 1.4, 2.0, 2.8}) merging.merge_pairs(reach_mm);
  EXPECT_LT(merging.mesh().positions.size(), 120U * 239 / 6);
  for (const glm::vec3& p : merging.mesh().positions) {
    EXPECT_NEAR(glm::length(p), 50.0, 0.1 * 2.8);  // what it may leave its planes by
  }
}

TEST(EdgeMerging, KeepsWhatIsThinAsThick) {
  const TriangleMesh thin = ring_mesh({}, 20.0, 1.0, 60);
  EdgeMerging merging(thin);
  for (const double reach_mm : {0.3, 0.42, 0.6}) merging.merge_pairs(reach_mm);
  EXPECT_LT(merging.mesh().triangles.size(), thin.triangles.size() / 4);
  EXPECT_NEAR(enclosed_volume(merging.mesh()) / enclosed_volume(thin), 1.0, 0.05);
}

TEST(EdgeMerging, LeavesWhatIsEmptyEmpty) {
  EdgeMerging merging({});
  merging.merge_pairs(1.0);
  EXPECT_TRUE(merging.mesh().positions.empty());
  EXPECT_TRUE(merging.mesh().triangles.empty());
  EXPECT_EQ(merging.farthest_mm(), 0.0);
}

TEST(EdgeMerging, KeepsPositionsFiniteForAnyReach) {
  for (const double reach_mm : {0.0, 1e-300, 1e300}) {
    EdgeMerging merging(two_rings());
    for (int i = 0; i < 20; ++i) merging.merge_pairs(reach_mm);
    for (const glm::vec3& p : merging.mesh().positions) EXPECT_LT(glm::length(p), 200.0F);
  }
}

/// In units of which determinants of quadrics, sixth powers of lengths, leave a float's range.
class DetailLevelsInUnits : public ::testing::TestWithParam<int> {};

TEST_P(DetailLevelsInUnits, AreThoseOfTheSameSurfaceInMillimetres) {
  const float unit_mm = std::ldexp(1.0F, GetParam());  // a power of two: nothing is rounded
  const std::vector<DetailLevel> expected = detail_levels(two_rings(), 100);
  const std::vector<DetailLevel> levels = detail_levels(scaled(two_rings(), unit_mm), 100);
  ASSERT_EQ(levels.size(), expected.size());
  ASSERT_GT(levels.size(), 4U);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    EXPECT_EQ(levels[i].error_mm, unit_mm * expected[i].error_mm);
    EXPECT_EQ(levels[i].mesh.triangles, expected[i].mesh.triangles);
    EXPECT_EQ(levels[i].mesh.corners, expected[i].mesh.corners);
    std::vector<float> positions = expected[i].mesh.positions;
    for (float& x : positions) x *= unit_mm;
    EXPECT_EQ(levels[i].mesh.positions, positions);
  }
}

/// About 1e-9, 1e-7, 1e6 and 1e15.
INSTANTIATE_TEST_SUITE_P(PowersOfTwo, DetailLevelsInUnits, ::testing::Values(-30, -23, 20, 50));

TEST(DetailLevels, HaveFewerTrianglesAndMoreError) {
  const std::vector<DetailLevel> levels = detail_levels(ball_mesh({}, 50.0, 60), 500);
  ASSERT_GT(levels.size(), 4U);
  EXPECT_EQ(levels.front().error_mm, 0.0);
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const auto share = static_cast<double>(levels[i].mesh.triangles) /
                       static_cast<double>(levels[i - 1].mesh.triangles);
    EXPECT_LT(share, 0.75);
    EXPECT_GT(share, 0.3);  // twice as fine at most as the one asked for
    EXPECT_GT(levels[i].error_mm, levels[i - 1].error_mm);
  }
  EXPECT_LE(levels.back().mesh.triangles, 500U);
}

TEST(DetailLevels, HaveAVertexWithinTheirErrorOfEachOfTheSurface) {
  const TriangleMesh mesh = two_rings();
  for (const DetailLevel& level : detail_levels(mesh, 100)) {
    const std::vector<glm::vec3> vertices = vertices_of(level.mesh);
    for (const glm::vec3& p : mesh.positions) {
      float nearest = glm::distance(vertices.front(), p);
      for (const glm::vec3& q : vertices) nearest = std::min(nearest, glm::distance(p, q));
      EXPECT_LE(nearest, level.error_mm + kRounding);
    }
  }
}

TEST(DetailLevels, OnlyTheSurfaceItselfWhereItIsSmall) {
  EXPECT_EQ(detail_levels(block_mesh({0, 0, 0}, {1, 1, 1}), 100).size(), 1U);
}

TEST(DetailLevels, EndWhereNothingCanBeMerged) {
  // The ball's many edges keep the mean edge and with it every reach short of the triangle.
  const TriangleMesh triangle{{{0, 0, 0}, {1e4, 0, 0}, {0, 1e4, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  const TriangleMesh mesh = join(ball_mesh({}, 1.0, 60), triangle);
  EXPECT_EQ(detail_levels(mesh, 1).back().mesh.triangles, 2U);
}

TEST(DetailLevels, EndWithNothingOfASurfaceThatIsAPoint) {
  const TriangleMesh point{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}, {0, 2, 1}}};
  const std::vector<DetailLevel> levels = detail_levels(point, 1);
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_EQ(levels.back().mesh.triangles, 0U);
  EXPECT_EQ(levels.back().error_mm, 0.0);
}

TEST(DetailLevels, OnlyTheSurfaceItselfWhereItIsEmpty) {
  const std::vector<DetailLevel> levels = detail_levels({}, 0);
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_EQ(levels.front().mesh.triangles, 0U);
}

TEST(DetailLevels, ShowTheSameForAllThreadsAndInstructions) {
  const ShellSet set = nested_balls(5, 50.0, 60);
  const Camera camera = make_camera({.size = {60, 60}, .azimuth_rad = 0.3}, {{}, 60.0});
  const auto draw = [&](std::size_t threads, InstructionSet instructions) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    CpuRenderer renderer({.detail_px = 1.5, .instructions = instructions});
    renderer.upload(set);
    const Image image = renderer.render(camera).volume;
    EXPECT_LT(renderer.last_frame().triangles, 5U * 2 * 60 * 119);
    return image.pixels;
  };
  const std::vector<float> expected = draw(1, InstructionSet::Baseline);
  EXPECT_EQ(draw(3, InstructionSet::Baseline), expected);
  for (const InstructionSet other : instruction_sets()) EXPECT_EQ(draw(2, other), expected);
}

}  // namespace
}  // namespace nacre::testing

#include "shells/verify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "core/quantization_grid.h"
#include "shells/build.h"
#include "shells/weld.h"
#include "tests/support/analytic_surfaces.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::cube_surface;
using testing::volume_of;

constexpr double kRadius = 14.0;

Volume ball() {
  return volume_of<float>({32, 32, 32}, [](std::int64_t i, std::int64_t j, std::int64_t k) {
    const double r = glm::distance(glm::dvec3(i, j, k), glm::dvec3(15.3, 15.6, 15.9));
    return std::max(0.0, 200.0 * (1.0 - r / kRadius));
  });
}

ShellSet balls(const Volume& volume, double tolerance) {
  BuildOptions options;
  options.levels = uniform_levels(3);
  options.emission_tolerance = tolerance;
  return build_shells(volume, EmissionMap::window(0, 200), options).set;
}

TEST(Verify, ShellsOfABallKeepAllPromises) {
  const ShellSet set = balls(ball(), 0.0);
  const std::vector<ShellVerdict> verdicts = verify_surfaces(set);
  ASSERT_EQ(verdicts.size(), 3u);
  for (const ShellVerdict& verdict : verdicts) {
    EXPECT_TRUE(broken_promises(verdict).empty());
    EXPECT_EQ(verdict.self_intersections, 0u);
  }
  ASSERT_TRUE(verdicts[0].next);
  EXPECT_FALSE(verdicts[2].next);
  EXPECT_EQ(verdicts[0].next->inner, 1u);
  EXPECT_EQ(verdicts[0].next->intersections.crossing, 0u);
  // A third of the range apart; vertices lie on the trilinear field's edges.
  EXPECT_NEAR(verdicts[0].next->gap_mm, kRadius / 3.0, 0.1);
}

TEST(Verify, FindsEachBrokenPromise) {
  const ShellSet whole = balls(ball(), 0.0);
  const auto broken = [&](auto&& damage) {
    ShellSet set = whole;
    damage(set.shells[0].surface);
    const std::vector<std::string> found = broken_promises(verify_surfaces(set)[0]);
    return found.empty() ? std::string() : found.front();
  };
  EXPECT_EQ(broken([](TriangleMesh&) {}), "");
  EXPECT_EQ(broken([](TriangleMesh& mesh) { mesh.triangles.pop_back(); }), "3 open edges");
  EXPECT_EQ(broken([](TriangleMesh& mesh) { std::swap(mesh.triangles[0].x, mesh.triangles[0].y); }),
            "3 edges of opposite orientation");
  EXPECT_EQ(broken([](TriangleMesh& mesh) { mesh.positions[0].x += 1e-3F; }),
            "1 positions off the grid");
  EXPECT_NE(broken([](TriangleMesh& mesh) {
              for (glm::uvec3& t : mesh.triangles) std::swap(t.x, t.y);
            }).find("inside out"),
            std::string::npos);
  EXPECT_NE(broken([](TriangleMesh& mesh) {
              mesh.positions[mesh.triangles[0].x] = mesh.positions[mesh.triangles[0].y];
            }).find("another's position"),
            std::string::npos);
}

// A triangle that is there twice: an edge of three ends somewhere.
TEST(Verify, FindsADuplicatedFace) {
  ShellSet set = balls(ball(), 0.0);
  auto& triangles = set.shells[0].surface.triangles;
  triangles.push_back(triangles[0]);
  const std::vector<std::string> found = broken_promises(verify_surfaces(set)[0]);
  EXPECT_NE(std::ranges::find(found, "3 edges of more than two triangles"), found.end());
}

TEST(Verify, SeesNeighboursCross) {
  ShellSet set = balls(ball(), 0.0);
  for (glm::vec3& p : set.shells[1].surface.positions) {
    p = grid_position(*set.grid, nearest_index(*set.grid, glm::dvec3(p) + glm::dvec3(5, 0, 0)));
  }
  const ShellVerdict verdict = verify_surfaces(set)[0];
  EXPECT_GT(verdict.next->intersections.crossing, 10u);
  EXPECT_EQ(verdict.next->gap_mm, 0.0);
}

TEST(Verify, MeasuresAgainstTheVolume) {
  const Volume volume = ball();
  for (const double tolerance : {0.0, 0.02}) {
    const ShellSet set = balls(volume, tolerance);
    const std::vector<VolumeVerdict> verdicts = verify_against_volume(set, volume);
    for (std::size_t k = 0; k < verdicts.size(); ++k) {
      const VolumeVerdict& verdict = verdicts[k];
      const SurfaceEmission& emission = verdict.emission;
      EXPECT_LE(emission.rms_error, emission.max_error);
      EXPECT_LE(emission.max_error, emission.error_bound(set.shells[k].emission) + 1e-9);
      EXPECT_TRUE(verdict.tolerance_kept);
      EXPECT_LE(verdict.to_unsimplified.lower_mm, verdict.to_unsimplified.upper_mm);
      // 0.02 of emission are 0.28 mm here; snapping moves by a hundredth of a millimetre.
      EXPECT_LT(verdict.to_unsimplified.upper_mm, tolerance > 0.0 ? 0.6 : 0.1);
      EXPECT_LT(verdict.from_unsimplified.upper_mm, tolerance > 0.0 ? 0.6 : 0.1);
    }
  }
}

TEST(Verify, FindsATolerancePassed) {
  const Volume volume = ball();
  ShellSet set = balls(volume, 0.0);
  set.tolerance = 0.01;  // a claim
  for (glm::vec3& p : set.shells[0].surface.positions) {
    p = grid_position(*set.grid, nearest_index(*set.grid, 1.1 * glm::dvec3(p)));
  }
  const std::vector<VolumeVerdict> verdicts = verify_against_volume(set, volume);
  EXPECT_FALSE(verdicts[0].tolerance_kept);
  EXPECT_TRUE(verdicts[1].tolerance_kept);
  EXPECT_NEAR(verdicts[0].to_unsimplified.lower_mm, 0.1 * kRadius * 5.0 / 6.0, 0.1);
}

// Oblique: caps snap to a staircase, and still count as caps.
TEST(Verify, KnowsCapsOfObliqueVolumes) {
  Volume volume = volume_of<float>({12, 12, 12}, [](auto x, auto, auto) { return 10 + x; });
  volume.world_from_voxel = glm::rotate(glm::dmat4(1.0), 0.3, glm::normalize(glm::dvec3(1, 2, 3)));
  BuildOptions options;
  options.levels = uniform_levels(2);
  const ShellSet set = build_shells(volume, EmissionMap::window(10, 21), options).set;
  for (const VolumeVerdict& verdict : verify_against_volume(set, volume)) {
    EXPECT_LT(verdict.emission.max_error, 0.002);  // half a step along each axis
  }
}

TEST(Weld, MergesEqualPositions) {
  TriangleMesh mesh = cube_surface(1.0F, 3);
  TriangleMesh soup;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (int i = 0; i < 3; ++i) soup.positions.push_back(mesh.positions[t[i]]);
    soup.triangles.emplace_back(first, first + 1, first + 2);
  }
  EXPECT_FALSE(check_shell(soup).is_closed());
  const TriangleMesh welded = weld(soup);
  EXPECT_EQ(welded.positions.size(), mesh.positions.size());
  EXPECT_TRUE(check_shell(welded).is_sound());
}

}  // namespace
}  // namespace nacre

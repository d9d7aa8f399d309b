#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/volume_geometry.h"
#include "extract/marching_cubes.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/test_volumes.h"

// Surfaces against closed forms, and what must not change them.

namespace nacre {
namespace {

using std::numbers::pi;
using testing::facts_of;
using testing::flaw_of;
using testing::MeshFacts;
using testing::random_volume;
using testing::volume_of;

constexpr double kRounding = 1e-5;  // of float positions, relative

/// Samples of `field` on n^3 points of the cube [-1, 1]^3, whose edge is 2 mm.
template <class Field>
Volume cube_of(int n, const Field& field) {
  const double step = 2.0 / (n - 1);
  Volume volume = volume_of<double>(
      {n, n, n}, [&](auto x, auto y, auto z) { return field(glm::dvec3(x, y, z) * step - 1.0); });
  for (int axis = 0; axis < 3; ++axis) volume.world_from_voxel[axis][axis] = step;
  volume.world_from_voxel[3] = {-1.0, -1.0, -1.0, 1.0};
  return volume;
}

MeshFacts contour(const Volume& volume, double value) {
  const MeshFacts facts = facts_of(extract_surfaces(volume, std::array{value})[0]);
  EXPECT_EQ(flaw_of(facts), "");
  return facts;
}

double sphere(const glm::dvec3& p) { return 0.8 - glm::length(p); }

double torus(const glm::dvec3& p) {
  const double ring = std::sqrt(p.x * p.x + p.y * p.y) - 0.6;
  return 0.25 - std::sqrt(ring * ring + p.z * p.z);
}

TEST(ExtractSurfaces, ConvergesToASphereAtSecondOrder) {
  const double area = 4.0 * pi * 0.64;
  const double content = 4.0 / 3.0 * pi * 0.512;
  // No symmetric lattices: 21 and 41 samples have their centre sample in the sphere's.
  const MeshFacts coarse = contour(cube_of(24, sphere), 0.0);
  const MeshFacts fine = contour(cube_of(47, sphere), 0.0);
  EXPECT_EQ(fine.euler_number(), 2);
  EXPECT_NEAR((area - coarse.area) / (area - fine.area), 4.0, 0.4);
  EXPECT_NEAR((content - coarse.volume) / (content - fine.volume), 4.0, 0.4);
  EXPECT_NEAR(fine.volume, content, 0.003 * content);
}

TEST(ExtractSurfaces, FindsTheHoleOfATorus) {
  const MeshFacts facts = contour(cube_of(48, torus), 0.0);
  EXPECT_EQ(facts.euler_number(), 0);
  EXPECT_EQ(facts.components, 1u);
  EXPECT_NEAR(facts.area, 4.0 * pi * pi * 0.6 * 0.25, 0.02);
  EXPECT_NEAR(facts.volume, 2.0 * pi * pi * 0.6 * 0.0625, 0.01);
}

TEST(ExtractSurfaces, NestsTheLevelsOfASphere) {
  const Volume volume = cube_of(30, sphere);
  const std::vector<double> values{0.0, 0.1, 0.3, 0.5, 0.7, 0.9};
  const std::vector<TriangleMesh> meshes = extract_surfaces(volume, values);
  for (std::size_t k = 0; k + 1 < values.size(); ++k) {
    for (const glm::vec3& p : meshes[k].positions) {
      EXPECT_NEAR(glm::length(glm::dvec3(p)), 0.8 - values[k], 0.02);
    }
    EXPECT_EQ(facts_of(meshes[k]).euler_number(), 2);
  }
  EXPECT_TRUE(meshes.back().positions.empty()) << "no sample reaches 0.9";
}

TEST(ExtractSurfaces, PutsVerticesWhereTheLinearFieldHasItsLevel) {
  Volume volume = volume_of<std::uint8_t>({6, 5, 4}, [](auto x, auto, auto) { return 10 * x; });
  volume.slope = 0.5;
  volume.intercept = -3.0;
  // value = 5 x - 3 >= 7.5 from x = 2.1 to the border at 5; the box's centre is at 2.5.
  const MeshFacts facts = contour(volume, 7.5);
  EXPECT_NEAR(facts.lo.x, 2.1 - 2.5, kRounding);
  EXPECT_EQ(facts.hi, glm::dvec3(2.5, 2.0, 1.5));
  EXPECT_NEAR(facts.volume, 2.9 * 4.0 * 3.0, 36.0 * kRounding);
}

TEST(ExtractSurfaces, CapsInTheBorderPlanes) {
  // Everything is inside: the surface is the volume's box.
  const Volume volume = random_volume<std::int16_t>({70, 4, 3}, 5.0, 9.0);
  const MeshFacts facts = contour(volume, 2.0);
  EXPECT_EQ(facts.lo, glm::dvec3(-34.5, -1.5, -1.0));
  EXPECT_EQ(facts.hi, glm::dvec3(34.5, 1.5, 1.0));
  EXPECT_NEAR(facts.volume, 69.0 * 3.0 * 2.0, 1e-3);
  EXPECT_NEAR(facts.area, 2.0 * (69.0 * 3.0 + 69.0 * 2.0 + 3.0 * 2.0), 1e-3);
}

TEST(ExtractSurfaces, GivesASingleSampleOneSpacing) {
  Volume volume = volume_of<float>({1, 1, 1}, [](auto, auto, auto) { return 3.0; });
  volume.world_from_voxel[0][0] = 2.0;
  volume.world_from_voxel[2][2] = 5.0;
  const MeshFacts facts = contour(volume, 3.0);
  EXPECT_EQ(facts.hi, glm::dvec3(1.0, 0.5, 2.5));
  EXPECT_NEAR(facts.volume, 10.0, kRounding);
  EXPECT_EQ(extract_surfaces(volume, std::array{3.5})[0].triangles.size(), 0u);
}

TEST(ExtractSurfaces, ExtrudesASingleSlice) {
  // A disc of radius 10 becomes a cylinder of height 3 mm.
  Volume volume = volume_of<double>({32, 32, 1}, [](auto x, auto y, auto) {
    return 10.0 - glm::length(glm::dvec2(x, y) - 15.3);
  });
  volume.world_from_voxel[2][2] = 3.0;
  const MeshFacts facts = contour(volume, 0.0);
  EXPECT_NEAR(facts.volume, 300.0 * pi, 0.01 * 300.0 * pi);
  EXPECT_EQ(facts.hi.z, 1.5);
}

TEST(ExtractSurfaces, ANegativeSlopeIsTheNegatedVolume) {
  const Volume plain = random_volume<std::int16_t>({9, 8, 7}, -500.0, 500.0);
  Volume negated =
      volume_of<std::int16_t>(plain.dims, [&, i = std::size_t{0}](auto, auto, auto) mutable {
        return -samples_as<std::int16_t>(plain)[i++];
      });
  negated.slope = -1.0;
  const std::vector<double> values{-321.5, 0.0, 100.0};
  const auto expected = extract_surfaces(plain, values);
  const auto found = extract_surfaces(negated, values);
  for (std::size_t k = 0; k < values.size(); ++k) {
    EXPECT_EQ(found[k].positions, expected[k].positions);
    EXPECT_EQ(found[k].triangles, expected[k].triangles);
  }
}

TEST(ExtractSurfaces, MirrorsALeftHandedLattice) {
  const Volume right = random_volume<std::uint8_t>({9, 8, 7}, 0.0, 255.0);
  Volume left = random_volume<std::uint8_t>({9, 8, 7}, 0.0, 255.0);
  left.world_from_voxel[0][0] = -1.0;
  const MeshFacts expected = contour(right, 100.0);
  const MeshFacts found = contour(left, 100.0);
  EXPECT_NEAR(found.volume, expected.volume, expected.volume * kRounding);
  EXPECT_NEAR(found.lo.x, -expected.hi.x, kRounding);
}

TEST(ExtractSurfaces, IsTheSameFarFromTheOrigin) {
  Volume near = random_volume<std::uint16_t>({9, 8, 7}, 0.0, 1000.0);
  near.world_from_voxel = glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(1, 2, 3));
  Volume far = random_volume<std::uint16_t>({9, 8, 7}, 0.0, 1000.0);
  far.world_from_voxel = near.world_from_voxel;
  far.world_from_voxel[3] = {1e7, -2e7, 3e7, 1.0};
  const std::array values{500.0};
  EXPECT_EQ(extract_surfaces(near, values)[0].positions,
            extract_surfaces(far, values)[0].positions);
}

TEST(ExtractSurfaces, ALevelDoesNotDependOnTheOthers) {
  const Volume volume = random_volume<std::uint8_t>({80, 9, 20}, 0.0, 255.0);
  std::vector<double> values(300);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = 0.5 + 0.8 * static_cast<double>(k);
  const auto together = extract_surfaces(volume, values);
  for (const std::size_t k : {std::size_t{0}, std::size_t{150}, std::size_t{260}}) {
    const auto alone = extract_surfaces(volume, std::array{values[k]});
    EXPECT_EQ(alone[0].positions, together[k].positions);
    EXPECT_EQ(alone[0].triangles, together[k].triangles);
  }
}

TEST(ExtractSurfaces, HasTheSameBytesForAnyNumberOfThreads) {
  const Volume volume = random_volume<std::uint16_t>({70, 30, 90}, 0.0, 1000.0);
  const std::vector<double> values{100.0, 500.0, 503.0, 800.0};
  std::vector<std::vector<TriangleMesh>> results;
  for (const std::size_t threads : {1, 2, 3}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(extract_surfaces(volume, values));
  }
  for (std::size_t i = 1; i < results.size(); ++i) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      EXPECT_EQ(results[i][k].positions, results[0][k].positions);
      EXPECT_EQ(results[i][k].triangles, results[0][k].triangles);
    }
  }
}

TEST(ExtractSurfaces, TellsItsProgress) {
  std::vector<double> told;
  const auto progress = [&told](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "extract");
    told.push_back(fraction);
  };
  extract_surfaces(random_volume<std::uint8_t>({9, 8, 30}, 0.0, 255.0), std::array{10.0}, progress);
  ASSERT_GE(told.size(), 2u);
  EXPECT_EQ(told.front(), 0.0);
  EXPECT_EQ(told.back(), 1.0);
}

TEST(ExtractSurfaces, RefusesWhatItCannotContour) {
  Volume volume = random_volume<std::uint8_t>({9, 8, 7}, 0.0, 255.0);
  EXPECT_TRUE(extract_surfaces(volume, {}).empty());
  EXPECT_THROW(extract_surfaces(volume, std::array{2.0, 1.0}), Error);
  EXPECT_THROW(extract_surfaces(volume, std::array{1.0, 1.0}), Error);
  EXPECT_THROW(extract_surfaces(volume, std::array{std::nan("")}), Error);
  volume.world_from_voxel[1] = volume.world_from_voxel[0];
  EXPECT_THROW(extract_surfaces(volume, std::array{1.0}), Error);
}

TEST(ExtractSurfaces, RefusesALatticeTooFineForFloat) {
  // A millionth of the box's width along one axis, seen obliquely.
  Volume volume = random_volume<std::uint8_t>({9, 8, 7}, 0.0, 255.0);
  volume.world_from_voxel = glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(1, 2, 3));
  volume.world_from_voxel[0] *= 1e-6;
  EXPECT_THROW(extract_surfaces(volume, std::array{100.0}), Error);
}

}  // namespace
}  // namespace nacre

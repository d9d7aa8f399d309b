#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/volume_geometry.h"
#include "extract/marching_cubes.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/test_volumes.h"

// Every surface of every volume is closed, edge-manifold, consistently oriented, encloses a
// positive volume and has no degenerate triangle.

namespace nacre {
namespace {

using testing::facts_of;
using testing::flaw_of;
using testing::MeshFacts;
using testing::random_volume;
using testing::volume_of;

/// Checks every surface.
void expect_sound(const Volume& volume, const std::vector<double>& values,
                  const std::string& what) {
  const std::vector<TriangleMesh> meshes = extract_surfaces(volume, values);
  ASSERT_EQ(meshes.size(), values.size());
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const MeshFacts facts = facts_of(meshes[k]);
    EXPECT_EQ(flaw_of(facts), "") << what << ", level " << values[k];
    EXPECT_TRUE(facts.triangles == 0 || facts.volume > 0.0) << what << ", level " << values[k];
  }
}

template <class T>
class ClosedSurfaces : public ::testing::Test {};

using StoredTypes = ::testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t,
                                     std::uint32_t, std::int32_t, float, double>;
TYPED_TEST_SUITE(ClosedSurfaces, StoredTypes);

TYPED_TEST(ClosedSurfaces, OfNoiseOverTheWholeRange) {
  const auto lo = static_cast<double>(std::numeric_limits<TypeParam>::lowest());
  const auto hi = static_cast<double>(std::numeric_limits<TypeParam>::max());
  std::vector<double> values;
  for (const double t : {0.0, 0.01, 0.25, 0.5, 0.75, 0.99, 1.0}) {
    values.push_back(lo * (1.0 - t) + hi * t);
  }
  // Above a row's 64 cells, so that bricks meet; no multiple of anything.
  for (const glm::i64vec3 dims : {glm::i64vec3(9, 8, 21), glm::i64vec3(131, 5, 4)}) {
    expect_sound(random_volume<TypeParam>(dims, lo, hi), values, "noise");
  }
}

TYPED_TEST(ClosedSurfaces, OfSamplesThatEqualLevels) {
  std::mt19937 random(3);
  const Volume volume = volume_of<TypeParam>(
      {12, 11, 13}, [&](auto, auto, auto) { return static_cast<double>(random() % 4); });
  expect_sound(volume, {0.0, 0.5, 1.0, 1.5, 2.0, 3.0}, "small integers");
}

TYPED_TEST(ClosedSurfaces, OfSingleSamples) {
  const std::vector<double> values{5.0, 20.0, 60.0, 100.0};
  for (int axes = 0; axes < 8; ++axes) {
    const glm::i64vec3 dims((axes & 1) != 0 ? 1 : 7, (axes & 2) != 0 ? 1 : 6,
                            (axes & 4) != 0 ? 1 : 5);
    expect_sound(random_volume<TypeParam>(dims, 0.0, 120.0), values,
                 "single axes " + std::to_string(axes));
  }
}

TEST(ClosedSurfaces, OfAllCornerMasks) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.01, 1.0);
  for (unsigned mask = 0; mask < 256; ++mask) {
    for (int trial = 0; trial < 12; ++trial) {
      const Volume volume = volume_of<float>({2, 2, 2}, [&](auto x, auto y, auto z) {
        const bool inside = (mask >> (x + 2 * y + 4 * z) & 1u) != 0;
        return inside ? unit(random) : -unit(random);
      });
      expect_sound(volume, {0.0}, "mask " + std::to_string(mask));
    }
  }
}

TEST(ClosedSurfaces, OfAllCornerMasksWithTies) {
  // Values of -2 to 2 around the level 0 make saddles exactly at the level, too.
  std::mt19937 random(7);
  for (int trial = 0; trial < 1000; ++trial) {
    const Volume volume = volume_of<std::int8_t>(
        {2, 2, 3}, [&](auto, auto, auto) { return static_cast<int>(random() % 5) - 2; });
    expect_sound(volume, {-1.0, 0.0, 1.0}, "trial " + std::to_string(trial));
  }
}

TEST(ClosedSurfaces, OfCheckerboards) {
  const auto checker = [](auto x, auto y, auto z) { return (x + y + z) % 2; };
  for (const double value : {0.25, 0.5, 0.75, 1.0}) {
    expect_sound(volume_of<std::uint8_t>({12, 11, 10}, checker), {value}, "checkerboard");
  }
}

TEST(ClosedSurfaces, OfLeftHandedAndSkewedLattices) {
  const std::vector<double> values{40.0, 120.0, 200.0};
  for (int flips = 0; flips < 8; ++flips) {
    Volume volume = random_volume<std::uint8_t>({11, 9, 10}, 0.0, 255.0);
    for (int axis = 0; axis < 3; ++axis) {
      if ((flips >> axis & 1) != 0) volume.world_from_voxel[axis] *= -1.0;
    }
    volume.world_from_voxel = glm::rotate(volume.world_from_voxel, 0.4, glm::dvec3(1, 2, 3));
    volume.world_from_voxel[1] += 0.2 * volume.world_from_voxel[0];
    expect_sound(volume, values, "flips " + std::to_string(flips));
    std::swap(volume.world_from_voxel[0], volume.world_from_voxel[2]);
    expect_sound(volume, values, "swapped, flips " + std::to_string(flips));
  }
}

TEST(ClosedSurfaces, OfNegativeSlopes) {
  Volume volume = random_volume<std::int16_t>({11, 9, 10}, -1000.0, 1000.0);
  volume.slope = -0.37;
  volume.intercept = 12.5;
  expect_sound(volume, {-400.0, -350.0, 0.0, 12.5, 200.0, 381.0, 382.5, 400.0}, "negative slope");
}

TEST(ClosedSurfaces, OfSpacingsOneToAThousand) {
  for (const double angle : {0.0, 0.3}) {
    Volume volume = random_volume<std::uint16_t>({17, 16, 15}, 0.0, 65535.0);
    volume.world_from_voxel = glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(1, 1, 2));
    volume.world_from_voxel[0] *= 0.01;
    volume.world_from_voxel[2] *= 10.0;
    expect_sound(volume, {100.0, 30000.0, 65535.0}, "angle " + std::to_string(angle));
  }
}

TEST(ClosedSurfaces, OfTinyAndHugeFloats) {
  for (const double scale : {1e-38, 1e-30, 1.0, 1e30, 1e38}) {
    const Volume volume = random_volume<float>({9, 9, 9}, -scale, scale);
    expect_sound(volume, {-0.9 * scale, 0.0, 0.3 * scale}, "f32 " + std::to_string(scale));
  }
  for (const double scale : {1e-300, 1e-160, 1e160, 1e308}) {
    const Volume volume = random_volume<double>({9, 9, 9}, -scale, scale);
    expect_sound(volume, {-0.9 * scale, 0.0, 0.3 * scale}, "f64 " + std::to_string(scale));
  }
}

TEST(ClosedSurfaces, OfThreeHundredLevels) {
  std::vector<double> values(300);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = 0.11 + 0.84 * static_cast<double>(k);
  expect_sound(random_volume<std::uint8_t>({10, 11, 12}, 0.0, 255.0), values, "levels");
  expect_sound(random_volume<float>({6, 7, 8}, 0.0, 255.0), values, "levels of floats");
}

TEST(ClosedSurfaces, OfLevelsOneUlpApart) {
  std::vector<double> values{100.0};
  for (int i = 0; i < 5; ++i) values.push_back(std::nextafter(values.back(), 1e9));
  values.push_back(static_cast<double>(std::nextafter(100.0f, 1e9f)));
  Volume volume = random_volume<float>({12, 12, 12}, 99.0, 101.0);
  for (float& sample : samples_as<float>(volume)) {
    if (sample < 99.5f) sample = 100.0f;  // some samples lie exactly there
  }
  expect_sound(volume, values, "ulps");
}

}  // namespace
}  // namespace nacre

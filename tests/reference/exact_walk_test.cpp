#include "reference/exact_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "tests/support/extended_cell.h"
#include "tests/support/fine_march.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::ExtendedCell;
using testing::FineMarch;
using testing::for_random_cells;
using testing::random_volume;
using testing::volume_of;

constexpr double kSingleCell = 1e-12;  // of the range: the promise
constexpr double kRounding = 1e-13;    // accumulated over a few hundred cells
constexpr double kMarch = 8e-3;        // a march in steps of 0.002 voxels on windows of 1/3 range

Ray ray_through(const glm::dvec3& a, const glm::dvec3& b) { return {a, glm::normalize(b - a)}; }

TEST(ExactWalk, MaximumOfRandomCellsMatchesExtendedPrecision) {
  const EmissionMap wide = EmissionMap::window(-1.0, 2.0);
  for_random_cells(300, [&](const Volume& cell, const Ray& ray) {
    const ExtendedCell extended(cell, ray);
    const ExactWalk walk(cell, wide);
    const auto expected =
        static_cast<double>(extended.maximum([](long double, long double value) { return value; }));
    EXPECT_NEAR(walk.max_value(ray), expected, kSingleCell);
    EXPECT_NEAR(walk.max_emission(ray), (expected + 1.0) / 3.0, kSingleCell);
  });
}

TEST(ExactWalk, IntegralOfRandomCellsMatchesExtendedPrecision) {
  const EmissionMap clamping = EmissionMap::window(0.35, 0.6);
  const EmissionMap bent =
      EmissionMap::piecewise_linear({{0.1, 0.05}, {0.3, 0.2}, {0.5, 0.2}, {0.55, 0.9}, {0.8, 1.0}});
  for (const EmissionMap& map : {clamping, bent}) {
    for_random_cells(100, [&](const Volume& cell, const Ray& ray) {
      const ExtendedCell extended(cell, ray);
      const auto expected = static_cast<double>(extended.integral(
          [&](long double, long double value) { return map(static_cast<double>(value)); }));
      EXPECT_NEAR(ExactWalk(cell, map).emission_integral(ray), expected, kSingleCell);
    });
  }
}

TEST(ExactWalk, ALinearFieldHasItsClosedForms) {
  // v = x + 2 y + 3 z on 20 x 15 x 10 samples; T = v / 100.
  const Volume volume = volume_of<float>(
      {20, 15, 10}, [](auto x, auto y, auto z) { return static_cast<double>(x + 2 * y + 3 * z); });
  const ExactWalk walk(volume, EmissionMap::window(0.0, 100.0));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    // From a point of the face z = 0 to a point of the face z = 9.
    const glm::dvec3 a(19 * unit(random), 14 * unit(random), 0.0);
    const glm::dvec3 b(19 * unit(random), 14 * unit(random), 9.0);
    const Ray ray = ray_through(a - (b - a), b);
    const auto value = [](const glm::dvec3& p) { return p.x + 2 * p.y + 3 * p.z; };
    EXPECT_NEAR(walk.max_value(ray), std::max(value(a), value(b)), 100 * kRounding);
    EXPECT_NEAR(walk.emission_integral(ray), glm::length(b - a) * (value(a) + value(b)) / 200.0,
                100 * kRounding);
  }
}

TEST(ExactWalk, SeparableQuadraticAlongAnAxisIsTheTrapezoid) {
  // Along a grid line the trilinear field of samples is piecewise linear between them.
  const auto f = [](auto x) { return 1.0 - 0.01 * static_cast<double>((x - 10) * (x - 10)); };
  const Volume volume = volume_of<double>(
      {21, 5, 5}, [&](auto x, auto y, auto z) { return f(x) * (y == 2 ? 1 : 0.5) * (z == 2); });
  const ExactWalk walk(volume, EmissionMap::window(0.0, 1.0));
  const Ray ray{{-7.0, 2.0, 2.0}, {1.0, 0.0, 0.0}};
  double trapezoid = 0.0;
  for (int x = 0; x < 20; ++x) trapezoid += 0.5 * (f(x) + f(x + 1));
  EXPECT_NEAR(walk.emission_integral(ray), trapezoid, kRounding * 20);
  EXPECT_NEAR(walk.max_emission(ray), 1.0, kRounding);
}

/// Largest difference of walk and march over random rays, for any volume.
void expect_agrees_with_a_fine_march(const Volume& volume, const EmissionMap& map,
                                     double tolerance) {
  const ExactWalk walk(volume, map);
  const FineMarch march(volume, map, 0.002);
  const BoundingSphere sphere = bounding_sphere(volume.dims, volume.world_from_voxel);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 20; ++trial) {
    const glm::dvec3 direction =
        glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const glm::dvec3 aside(normal(random), normal(random), normal(random));
    const double reach = 2.0 * sphere.radius_mm;
    const Ray ray{sphere.center_mm + 0.2 * sphere.radius_mm * aside - reach * direction, direction};
    // At a kink of the field (a cell's face) a march is wrong by up to slope times step.
    EXPECT_NEAR(walk.max_emission(ray), march.max_emission(ray, 0.0, 2.0 * reach), tolerance);
    EXPECT_NEAR(walk.emission_integral(ray) / sphere.radius_mm,
                march.emission_integral(ray, 0.0, 2.0 * reach) / sphere.radius_mm, tolerance);
  }
}

TEST(ExactWalk, AgreesWithAFineMarchInEveryStoredType) {
  const EmissionMap map = EmissionMap::window(20.0, 90.0);
  expect_agrees_with_a_fine_march(random_volume<std::uint8_t>({13, 10, 18}, 0, 120), map, kMarch);
  expect_agrees_with_a_fine_march(random_volume<std::int8_t>({13, 10, 18}, -100, 120), map, kMarch);
  expect_agrees_with_a_fine_march(random_volume<std::uint16_t>({9, 10, 8}, 0, 120), map, kMarch);
  expect_agrees_with_a_fine_march(random_volume<std::int16_t>({9, 1, 8}, -50, 120), map, kMarch);
  expect_agrees_with_a_fine_march(random_volume<std::uint32_t>({1, 9, 8}, 0, 120), map, kMarch);
  expect_agrees_with_a_fine_march(random_volume<std::int32_t>({9, 8, 1}, -50, 120), map, kMarch);
  expect_agrees_with_a_fine_march(random_volume<float>({9, 8, 7}, -50, 120), map, kMarch);
  expect_agrees_with_a_fine_march(random_volume<double>({2, 2, 33}, -50, 120), map, kMarch);
}

TEST(ExactWalk, HonoursSlopeInterceptAndGeometry) {
  Volume volume = random_volume<std::int16_t>({12, 9, 14}, -100, 100);
  volume.slope = -2.5;  // falling: the largest value is the smallest sample
  volume.intercept = 40.0;
  volume.world_from_voxel[0] = {-0.3, 0.1, 0.0, 0.0};  // left-handed, oblique, sheared, anisotropic
  volume.world_from_voxel[1] = {0.1, 0.4, 0.05, 0.0};
  volume.world_from_voxel[2] = {0.2, 0.0, 2.0, 0.0};
  volume.world_from_voxel[3] = {100.0, -200.0, 300.0, 1.0};
  expect_agrees_with_a_fine_march(volume, EmissionMap::window(-50.0, 200.0), kMarch);
}

TEST(ExactWalk, SkippingBricksLosesNothing) {
  // A single bright voxel far from everything, in every octant of a brick and on brick borders.
  for (const std::int64_t at : {1, 7, 8, 9, 15, 16, 17, 23, 29}) {
    const Volume volume = volume_of<std::uint8_t>({31, 31, 31}, [at](auto x, auto y, auto z) {
      return x == at && y == at && z == at ? 200 : 0;
    });
    const ExactWalk walk(volume, EmissionMap::window(0.0, 255.0));
    const glm::dvec3 p(at, at, at);
    for (const glm::dvec3 direction :
         {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 1, 1),
          glm::dvec3(-1, 1, 0.5), glm::dvec3(0.1, -1, -0.3)}) {
      const Ray ray = ray_through(p - 100.0 * direction, p);
      EXPECT_NEAR(walk.max_emission(ray), 200.0 / 255.0, 1e-12) << at;
    }
  }
}

// The field is continuous, so a ray along a face, an edge or through vertices sees what rays a hair
// beside it see; none is lost between cells or counted in both.
TEST(ExactWalk, RaysBetweenCellsAreNeitherLostNorCountedTwice) {
  const Volume volume = random_volume<double>({17, 17, 17}, 0.2, 1.0);
  const ExactWalk walk(volume, EmissionMap::window(0.0, 1.0));
  for (const double sign : {-1.0, 1.0}) {
    for (const glm::dvec3 direction : {glm::dvec3(1, 0, 0), glm::dvec3(1, 1, 0),
                                       glm::dvec3(1, 1, 1), glm::dvec3(1, 1e-12, -1e-13)}) {
      for (const glm::dvec3 through : {glm::dvec3(8, 8, 8), glm::dvec3(8, 5, 5.5),
                                       glm::dvec3(8, 0, 0), glm::dvec3(3, 16, 16)}) {
        const glm::dvec3 d = glm::normalize(sign * direction);
        const Ray exact{through - 40.0 * d, d};
        const glm::dvec3 inwards = 1e-9 * glm::normalize(glm::dvec3(8.1, 8.2, 8.3) - through);
        const Ray beside{exact.origin_mm + inwards, d};
        EXPECT_NEAR(walk.max_emission(exact), walk.max_emission(beside), 1e-7);
        EXPECT_NEAR(walk.emission_integral(exact), walk.emission_integral(beside), 1e-6);
      }
    }
  }
}

TEST(ExactWalk, IntervalsAddUp) {
  const Volume volume = random_volume<float>({12, 13, 14}, 0.0, 1.0);
  const ExactWalk walk(volume, EmissionMap::window(0.1, 0.8));
  const Ray ray = ray_through({-5, 1, 2}, {14, 9, 12});
  const double whole = walk.emission_integral(ray);
  for (const double cut : {5.0, 7.3, 11.0, 18.5}) {
    const double near = walk.emission_integral(ray, {-1e300, cut});
    const double far = walk.emission_integral(ray, {cut, 1e300});
    EXPECT_NEAR(near + far, whole, kRounding * 100);
    EXPECT_EQ(std::max(walk.max_emission(ray, {0.0, cut}), walk.max_emission(ray, {cut, 1e9})),
              walk.max_emission(ray));
  }
}

TEST(ExactWalk, MissesAreZero) {
  const Volume volume = random_volume<float>({4, 4, 4}, 0.5, 1.0);
  const ExactWalk walk(volume, EmissionMap::window(0.0, 1.0));
  const Ray past{{-5, 3.5, 0}, {1, 0, 0}};
  EXPECT_EQ(walk.max_emission(past), 0.0);
  EXPECT_EQ(walk.emission_integral(past), 0.0);
  EXPECT_TRUE(std::isnan(walk.max_value(past)));
  // In front of the box, and ended before it.
  EXPECT_EQ(walk.max_emission({{-5, 2, 2}, {1, 0, 0}}, {0.0, 4.9}), 0.0);
}

TEST(ExactWalk, OneVoxelIsAConstantBoxOfOneSpacing) {
  Volume volume = volume_of<std::uint8_t>({1, 1, 1}, [](auto, auto, auto) { return 100; });
  volume.world_from_voxel[0] = {2, 0, 0, 0};
  const ExactWalk walk(volume, EmissionMap::window(0.0, 200.0));
  EXPECT_NEAR(walk.emission_integral({{-9, 0.2, -0.3}, {1, 0, 0}}), 0.5 * 2.0, kRounding);
  EXPECT_NEAR(walk.emission_integral({{0.9, 0.2, -9}, {0, 0, 1}}), 0.5, kRounding);
  EXPECT_EQ(walk.max_emission({{0.9, 0.6, -9}, {0, 0, 1}}), 0.0);
}

TEST(ExactWalk, HoldsFromTheSmallestToTheLargestSamples) {
  for (const double scale : {1e-300, 1e-38, 1e38, 1.7e308}) {
    Volume volume = random_volume<double>({5, 5, 5}, -scale, scale);
    const Volume unit = random_volume<double>({5, 5, 5}, -1.0, 1.0);
    const Ray ray = ray_through({-1, 0.3, 0.4}, {5, 3.1, 2.2});
    const ExactWalk walk(volume, EmissionMap::window(-scale, scale));
    const ExactWalk unit_walk(unit, EmissionMap::window(-1.0, 1.0));
    EXPECT_NEAR(walk.max_emission(ray), unit_walk.max_emission(ray), 1e-12) << scale;
    EXPECT_NEAR(walk.emission_integral(ray), unit_walk.emission_integral(ray), 1e-12) << scale;
  }
}

TEST(ExactWalk, FarFromTheOriginCostsOnlyTheDigitsOfTheCoordinates) {
  Volume near = random_volume<float>({9, 9, 9}, 0.0, 1.0);
  Volume far = random_volume<float>({9, 9, 9}, 0.0, 1.0);
  const glm::dvec3 offset(1e6, -1e6, 1e6);
  far.world_from_voxel[3] = glm::dvec4(offset, 1.0);
  const EmissionMap map = EmissionMap::window(0.0, 1.0);
  const Ray ray = ray_through({-1, 3.3, 2.4}, {9, 4.1, 6.2});
  const Ray far_ray{ray.origin_mm + offset, ray.direction};
  EXPECT_NEAR(ExactWalk(far, map).max_emission(far_ray), ExactWalk(near, map).max_emission(ray),
              1e-9);
}

TEST(ExactWalk, WindowOfOneUlpIsAStep) {
  const Volume volume = random_volume<double>({6, 6, 6}, 0.0, 2.0);
  const double lo = 1.0;
  const ExactWalk step(volume, EmissionMap::window(lo, std::nextafter(lo, 2.0)));
  const ExactWalk nearly(volume, EmissionMap::window(lo - 1e-10, lo + 1e-10));
  const Ray ray = ray_through({-1, 1.3, 2.4}, {9, 4.1, 3.2});
  EXPECT_EQ(step.max_emission(ray), 1.0);
  EXPECT_NEAR(step.emission_integral(ray), nearly.emission_integral(ray), 1e-8);
}

}  // namespace
}  // namespace nacre

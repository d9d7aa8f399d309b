// The exact walk under a depth cue.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "core/volume_geometry.h"
#include "reference/exact_walk.h"
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
#ifdef NDEBUG
constexpr int kCells = 60;
constexpr int kRays = 20;
#else
constexpr int kCells = 15;
constexpr int kRays = 4;
#endif

Ray ray_through(const glm::dvec3& a, const glm::dvec3& b) { return {a, glm::normalize(b - a)}; }

double beta_at(const CueField& cue, const glm::dvec3& p) {
  return cue.at_center + glm::dot(cue.rise_per_mm, p - cue.center_mm);
}

/// A cue that is `at_lo` at the origin and `at_hi` at the unit cell's far corner.
CueField cell_cue(double at_lo, double at_hi) {
  return {0.5 * (at_lo + at_hi), glm::dvec3(0.5), glm::dvec3((at_hi - at_lo) / 3.0)};
}

TEST(CuedWalk, RandomCellsMatchExtendedPrecision) {
  const EmissionMap clamping = EmissionMap::window(0.35, 0.6);
  const EmissionMap bent =
      EmissionMap::piecewise_linear({{0.1, 0.05}, {0.3, 0.2}, {0.5, 0.2}, {0.55, 0.9}, {0.8, 1.0}});
  for (const EmissionMap& map : {clamping, bent}) {
    for (const CueField& cue : {cell_cue(0.0, 1.0), cell_cue(1.0, 0.2)}) {
      for_random_cells(kCells, [&](const Volume& cell, const Ray& ray) {
        const ExtendedCell extended(cell, ray);
        const long double along = glm::dot(cue.rise_per_mm, ray.direction);
        const long double start = beta_at(cue, ray.origin_mm);
        const auto cued = [&](long double t, long double value) {
          return (start + along * t) * map(static_cast<double>(value));
        };
        const ExactWalk walk(cell, map);
        EXPECT_NEAR(walk.max_emission(ray, {}, cue), static_cast<double>(extended.maximum(cued)),
                    kSingleCell);
        EXPECT_NEAR(walk.emission_integral(ray, {}, cue),
                    static_cast<double>(extended.integral(cued)), kSingleCell);
      });
    }
  }
}

TEST(CuedWalk, ALinearFieldHasItsClosedForms) {
  // v = x on 21 samples, T = x / 20, beta = 1 - x / 20 along x: s - s^2.
  const Volume volume =
      volume_of<float>({21, 5, 5}, [](auto x, auto, auto) { return static_cast<double>(x); });
  const ExactWalk walk(volume, EmissionMap::window(0.0, 20.0));
  const CueField cue{0.5, {10.0, 2.0, 2.0}, {-1.0 / 20.0, 0.0, 0.0}};
  for (const double sign : {-1.0, 1.0}) {
    const Ray ray{{10.0 - 50.0 * sign, 1.3, 2.4}, {sign, 0.0, 0.0}};
    EXPECT_NEAR(walk.max_emission(ray, {}, cue), 0.25, 1e-14);
    EXPECT_NEAR(walk.emission_integral(ray, {}, cue), 20.0 / 6.0, 1e-13);
  }
}

TEST(CuedWalk, AFlatCueIsAFactor) {
  const Volume volume = random_volume<std::uint8_t>({20, 17, 12}, 0, 255);
  const ExactWalk walk(volume, EmissionMap::window(40.0, 230.0));
  for (int i = 0; i < kRays; ++i) {
    const Ray ray = ray_through({-5.0, 0.4 * i, 3.0}, {22.0, 14.0 - 0.5 * i, 9.0});
    const double most = walk.max_emission(ray);
    const double sum = walk.emission_integral(ray);
    EXPECT_EQ(walk.max_emission(ray, {}, {.at_center = 1.0}), most);
    EXPECT_EQ(walk.emission_integral(ray, {}, {.at_center = 1.0}), sum);
    EXPECT_EQ(walk.max_emission(ray, {}, {.at_center = 0.3}), 0.3 * most);
    EXPECT_EQ(walk.emission_integral(ray, {}, {.at_center = 0.3}), 0.3 * sum);
    // A hair from flat, the walk of cues must agree with the other.
    const CueField nearly{1.0, {10.0, 8.0, 6.0}, {1e-14, -1e-14, 1e-14}};
    EXPECT_NEAR(walk.max_emission(ray, {}, nearly), most, 1e-12);
    EXPECT_NEAR(walk.emission_integral(ray, {}, nearly), sum, 1e-11);
  }
}

TEST(CuedWalk, TheSumIsLinearInTheCue) {
  const Volume volume = random_volume<float>({19, 14, 12}, 0.0, 1.0);
  const ExactWalk walk(volume, EmissionMap::window(0.2, 0.7));
  const CueField a{0.5, {9.0, 7.0, 6.0}, {0.01, -0.02, 0.02}};
  const CueField b{0.9, {9.0, 7.0, 6.0}, {-0.03, 0.01, 0.01}};
  const CueField both{1.4, {9.0, 7.0, 6.0}, {-0.02, -0.01, 0.03}};
  for (int i = 0; i < kRays; ++i) {
    const Ray ray = ray_through({-5.0, 0.5 * i, 3.0}, {22.0, 12.0 - 0.5 * i, 9.0});
    EXPECT_NEAR(walk.emission_integral(ray, {}, a) + walk.emission_integral(ray, {}, b),
                walk.emission_integral(ray, {}, both), 1e-12);
  }
}

TEST(CuedWalk, ARayAndItsReverseSeeTheSame) {
  const Volume volume = random_volume<std::int16_t>({30, 25, 20}, -200, 800);
  const ExactWalk walk(volume, EmissionMap::window(0.0, 900.0));
  const CueField cue{0.5, {15.0, 12.0, 10.0}, {0.02, 0.01, -0.015}};
  for (int i = 0; i < kRays; ++i) {
    const glm::dvec3 a(-4.0, 1.0 + i, 3.0);
    const glm::dvec3 b(33.0, 20.0 - i, 15.0);
    EXPECT_NEAR(walk.max_emission(ray_through(a, b), {}, cue),
                walk.max_emission(ray_through(b, a), {}, cue), 1e-13);
    EXPECT_NEAR(walk.emission_integral(ray_through(a, b), {}, cue),
                walk.emission_integral(ray_through(b, a), {}, cue), 1e-12);
  }
}

// A march in steps h errs by order h^2 in the integral, and from below in the maximum.
TEST(CuedWalk, AFineMarchConvergesToItAtItsOwnOrder) {
  Volume volume = random_volume<std::int16_t>({10, 9, 8}, -100, 100);
  volume.slope = -2.5;
  volume.intercept = 40.0;
  volume.world_from_voxel[0] = {-0.3, 0.1, 0.0, 0.0};  // left-handed, sheared
  volume.world_from_voxel[1] = {0.1, 0.4, 0.05, 0.0};
  volume.world_from_voxel[2] = {0.2, 0.0, 0.7, 0.0};
  volume.world_from_voxel[3] = {100.0, -200.0, 300.0, 1.0};
  const EmissionMap map = EmissionMap::window(-150.0, 250.0);
  const BoundingSphere sphere = bounding_sphere(volume.dims, volume.world_from_voxel);
  const CueField cue{0.5, sphere.center_mm, glm::dvec3(0.2, 0.1, -0.15) / sphere.radius_mm};
  const auto weight = [&](const glm::dvec3& p) { return beta_at(cue, p); };
  const ExactWalk walk(volume, map);
  // Within the box, whose border would be a jump, and a whole number of steps long.
  const RayInterval cut{9.2, 9.2 + 5.0 * glm::length(glm::dvec3(volume.world_from_voxel[0]))};
  const auto worst = [&](double step) {
    const FineMarch march(volume, map, step);
    glm::dvec2 most_off(0.0);
    for (int i = 0; i < kRays; ++i) {
      const glm::dvec3 d = glm::normalize(glm::dvec3(1.0, 0.3 * i - 2.0, 0.7));
      const Ray ray{sphere.center_mm - 10.0 * d + glm::dvec3(0.02 * i - 0.2, 0.1, -0.02 * i), d};
      const double most = walk.max_emission(ray, cut, cue);
      const double marched = march.max_emission(ray, cut.t_begin_mm, cut.t_end_mm, weight);
      EXPECT_LE(marched, most + 1e-13);
      most_off.x = std::max(most_off.x, most - marched);
      most_off.y += std::abs(walk.emission_integral(ray, cut, cue) -
                             march.emission_integral(ray, cut.t_begin_mm, cut.t_end_mm, weight));
    }
    return most_off;
  };
  const glm::dvec2 coarse = worst(0.1);
  const glm::dvec2 fine = worst(0.01);
  EXPECT_LT(fine.x, 0.2 * coarse.x);
  EXPECT_LT(fine.y, 0.05 * coarse.y);
}

// As the uncued walk does: a ray along faces, edges or vertices sees what its neighbours see.
TEST(CuedWalk, RaysBetweenCellsAreNeitherLostNorCountedTwice) {
  const Volume volume = random_volume<double>({17, 17, 17}, 0.2, 1.0);
  const ExactWalk walk(volume, EmissionMap::window(0.0, 1.0));
  const CueField cue{0.6, glm::dvec3(8.0), {0.02, -0.01, 0.015}};
  for (const double sign : {-1.0, 1.0}) {
    for (const glm::dvec3 direction : {glm::dvec3(1, 0, 0), glm::dvec3(1, 1, 0),
                                       glm::dvec3(1, 1, 1), glm::dvec3(1, 1e-12, -1e-13)}) {
      for (const glm::dvec3 through : {glm::dvec3(8, 8, 8), glm::dvec3(8, 5, 5.5),
                                       glm::dvec3(8, 0, 0), glm::dvec3(3, 16, 16)}) {
        const glm::dvec3 d = glm::normalize(sign * direction);
        const Ray exact{through - 40.0 * d, d};
        const glm::dvec3 inwards = 1e-9 * glm::normalize(glm::dvec3(8.1, 8.2, 8.3) - through);
        const Ray beside{exact.origin_mm + inwards, d};
        EXPECT_NEAR(walk.max_emission(exact, {}, cue), walk.max_emission(beside, {}, cue), 1e-7);
        EXPECT_NEAR(walk.emission_integral(exact, {}, cue), walk.emission_integral(beside, {}, cue),
                    1e-6);
      }
    }
  }
}

TEST(CuedWalk, HoldsFromTheSmallestToTheLargestSamplesAndCues) {
  const Volume unit = random_volume<double>({5, 5, 5}, -1.0, 1.0);
  const ExactWalk unit_walk(unit, EmissionMap::window(-1.0, 1.0));
  const Ray ray = ray_through({-1, 0.3, 0.4}, {5, 3.1, 2.2});
  const CueField cue{0.5, glm::dvec3(2.0), {0.1, -0.05, 0.02}};
  const double most = unit_walk.max_emission(ray, {}, cue);
  const double sum = unit_walk.emission_integral(ray, {}, cue);
  for (const double scale : {1e-300, 1e-38, 1e38, 1.7e308}) {
    const Volume volume = random_volume<double>({5, 5, 5}, -scale, scale);
    const ExactWalk walk(volume, EmissionMap::window(-scale, scale));
    EXPECT_NEAR(walk.max_emission(ray, {}, cue), most, 1e-12) << scale;
    EXPECT_NEAR(walk.emission_integral(ray, {}, cue), sum, 1e-12) << scale;
  }
  for (const double scale : {1e-300, 1e300}) {
    const CueField scaled{scale * cue.at_center, cue.center_mm, scale * cue.rise_per_mm};
    EXPECT_NEAR(unit_walk.max_emission(ray, {}, scaled) / scale, most, 1e-12) << scale;
    EXPECT_NEAR(unit_walk.emission_integral(ray, {}, scaled) / scale, sum, 1e-12) << scale;
  }
}

TEST(CuedWalk, DenormalSamplesKeepTheirDigits) {
  const double scale = 1e-310;
  const Volume volume = random_volume<double>({5, 5, 5}, 0.0, scale);
  const Volume unit = random_volume<double>({5, 5, 5}, 0.0, 1.0);
  const ExactWalk walk(volume, EmissionMap::window(0.0, scale));
  const ExactWalk unit_walk(unit, EmissionMap::window(0.0, 1.0));
  const Ray ray = ray_through({-1, 0.3, 0.4}, {5, 3.1, 2.2});
  const CueField cue{0.5, glm::dvec3(2.0), {0.1, -0.05, 0.02}};
  constexpr double kDenormal = 1e-12;  // 5e-324 of 1e-310, a few times
  EXPECT_NEAR(walk.max_emission(ray, {}, cue), unit_walk.max_emission(ray, {}, cue), kDenormal);
  EXPECT_NEAR(walk.emission_integral(ray, {}, cue), unit_walk.emission_integral(ray, {}, cue),
              10.0 * kDenormal);
}

TEST(CuedWalk, ACueOfManyOrdersKeepsItsFarEnd) {
  // beta falls from 1e12 to 1 over a constant field: the far part must not drown.
  const Volume volume = volume_of<std::uint8_t>({11, 3, 3}, [](auto, auto, auto) { return 1; });
  const ExactWalk walk(volume, EmissionMap::window(0.0, 1.0));
  const CueField cue{0.5 * (1e12 + 1.0), {5.0, 1.0, 1.0}, {-(1e12 - 1.0) / 10.0, 0.0, 0.0}};
  const Ray ray{{-5.0, 1.2, 0.7}, {1.0, 0.0, 0.0}};
  EXPECT_NEAR(walk.max_emission(ray, {}, cue), 1e12, 1e-3);
  EXPECT_NEAR(walk.emission_integral(ray, {}, cue) / (5e12 + 5.0), 1.0, 1e-14);
  EXPECT_NEAR(walk.max_emission(ray, {14.9999, 99.0}, cue), 1e7 + 1.0, 1e-3);
}

TEST(CuedWalk, AFarEyeCostsNoDigits) {
  const Volume volume = random_volume<float>({9, 9, 9}, 0.0, 1.0);
  const ExactWalk walk(volume, EmissionMap::window(0.0, 1.0));
  const CueField cue{0.5, glm::dvec3(4.0), {0.05, 0.02, 0.0}};
  const Ray near{{-8.0, 3.25, 4.5}, {1.0, 0.0, 0.0}};
  const Ray far{{-8.0 - 1e9, 3.25, 4.5}, {1.0, 0.0, 0.0}};
  // The entry's own rounding, 1e9 times 1e-16, times the field's slope.
  EXPECT_NEAR(walk.max_emission(far, {}, cue), walk.max_emission(near, {}, cue), 1e-6);
  EXPECT_NEAR(walk.emission_integral(far, {}, cue), walk.emission_integral(near, {}, cue), 1e-6);
}

TEST(CuedWalk, MissesAndBlackCuesAreZero) {
  const Volume volume = random_volume<float>({4, 4, 4}, 0.5, 1.0);
  const ExactWalk walk(volume, EmissionMap::window(0.0, 1.0));
  const CueField cue{0.5, glm::dvec3(1.5), {0.1, 0.0, 0.0}};
  const CueField negative{-1.0, glm::dvec3(1.5), {0.1, 0.0, 0.0}};
  const Ray past{{-5, 3.5, 0}, {1, 0, 0}};
  const Ray through{{-5, 1.5, 1}, {1, 0, 0}};
  EXPECT_EQ(walk.max_emission(past, {}, cue), 0.0);
  EXPECT_EQ(walk.emission_integral(past, {}, cue), 0.0);
  EXPECT_EQ(walk.max_emission(through, {}, negative), 0.0);
  EXPECT_EQ(walk.emission_integral(through, {}, negative), 0.0);
}

}  // namespace
}  // namespace nacre

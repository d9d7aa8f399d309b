#include "datasets/angiogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/volume_geometry.h"

namespace nacre {
namespace {

constexpr glm::i64vec3 kSmall{64, 64, 31};

TEST(VesselCoverage, OnTheAxisIsADiscUnderAGaussian) {
  for (const double radius : {0.2, 0.5, 1.0, 3.0}) {
    const double x = radius / 0.4;
    EXPECT_NEAR(vessel_coverage(0.0, radius, 0.4), 1.0 - std::exp(-0.5 * x * x), 1e-6);
  }
}

TEST(VesselCoverage, TendsToAPlaneWall) {
  EXPECT_NEAR(vessel_coverage(30.0, 30.0, 0.4), 0.5, 1e-6);
  EXPECT_NEAR(vessel_coverage(30.4, 30.0, 0.4), 0.5 * std::erfc(std::sqrt(0.5)), 1e-6);
}

TEST(VesselCoverage, TendsToAGaussianLine) {
  constexpr double thin = 0.02;  // of a spread of 1: the next term is its square
  const double peak = vessel_coverage(0.0, thin, 1.0);
  EXPECT_NEAR(vessel_coverage(1.3, thin, 1.0) / peak, std::exp(-0.5 * 1.3 * 1.3), 1e-3);
}

/// Mean and mean square of many magnitudes.
struct Moments {
  double mean = 0.0;
  double mean_square = 0.0;
};

Moments moments(double signal, double sigma, int draws) {
  Moments sum;
  for (int i = 0; i < draws; ++i) {
    const double m = rician_magnitude(signal, sigma, 5, static_cast<std::uint64_t>(i));
    sum.mean += m / draws;
    sum.mean_square += m * m / draws;
  }
  return sum;
}

/// E[m] = sigma sqrt(pi / 2) L_1/2(-signal^2 / 2 sigma^2), the Laguerre function by Bessel's.
double rician_mean(double signal, double sigma) {
  const double q = signal * signal / (4.0 * sigma * sigma);
  const double laguerre = std::exp(-q) * ((1.0 + 2.0 * q) * std::cyl_bessel_i(0.0, q) +
                                          2.0 * q * std::cyl_bessel_i(1.0, q));
  return sigma * std::sqrt(std::numbers::pi / 2.0) * laguerre;
}

TEST(RicianMagnitude, HasRicesMeanAndMeanSquare) {
  constexpr int draws = 200'000;
  constexpr double sigma = 20.0;
  for (const double signal : {0.0, 15.0, 60.0, 300.0}) {
    const Moments found = moments(signal, sigma, draws);
    const double spread = 5.0 * sigma / std::sqrt(draws);
    EXPECT_NEAR(found.mean, rician_mean(signal, sigma), spread) << signal;
    EXPECT_NEAR(found.mean_square, signal * signal + 2.0 * sigma * sigma,
                spread * 2.0 * (signal + sigma))
        << signal;
  }
}

TEST(RicianMagnitude, WithoutNoiseIsTheSignal) {
  EXPECT_EQ(rician_magnitude(42.5, 0.0, 1, 1), 42.5);
}

/// The samples outside the head: the eight corners' slices of the volume's first rows.
std::vector<double> air_samples(const Volume& volume) {
  const auto samples = samples_as<std::int16_t>(volume);
  std::vector<double> air;
  for (std::int64_t z = 0; z < volume.dims.z; ++z) {
    for (std::int64_t x = 0; x < volume.dims.x / 8; ++x) {
      for (std::int64_t y = 0; y < volume.dims.y / 8; ++y) {
        air.push_back(
            samples[static_cast<std::size_t>(x + volume.dims.x * (y + volume.dims.y * z))]);
      }
    }
  }
  return air;
}

TEST(Angiogram, AirIsRayleighDistributed) {
  constexpr double sigma = 30.0;
  const Volume volume = make_angiogram({.size = kSmall, .seed = 1, .noise = sigma});
  const std::vector<double> air = air_samples(volume);
  double mean = 0.0;
  double square = 0.0;
  for (const double m : air) {
    mean += m / static_cast<double>(air.size());
    square += m * m / static_cast<double>(air.size());
  }
  const double chance = 5.0 * sigma / std::sqrt(static_cast<double>(air.size()));
  EXPECT_NEAR(mean, sigma * std::sqrt(std::numbers::pi / 2.0), chance);
  EXPECT_NEAR(square - mean * mean, (2.0 - std::numbers::pi / 2.0) * sigma * sigma,
              2.0 * sigma * chance);
}

TEST(Angiogram, VesselsOutshineTheTissue) {
  const Volume volume = make_angiogram({.size = {96, 96, 48}, .seed = 1, .noise = 0.0});
  const auto samples = samples_as<std::int16_t>(volume);
  const auto bright = std::ranges::count_if(samples, [](std::int16_t v) { return v > 400; });
  const double part = static_cast<double>(bright) / static_cast<double>(samples.size());
  EXPECT_GT(part, 0.002);
  EXPECT_LT(part, 0.03);
  EXPECT_GT(*std::ranges::max_element(samples), 1200);
  EXPECT_GE(*std::ranges::min_element(samples), 0);
}

TEST(Angiogram, CoversTheSameFieldOfViewAtAnySize) {
  for (const glm::i64vec3 size : {kSmall, glm::i64vec3(20, 33, 7)}) {
    const Volume volume = make_angiogram({.size = size, .seed = 1, .noise = 0.0});
    const glm::dvec3 spacing = spacing_mm(volume.world_from_voxel);
    const BoundingSphere sphere = bounding_sphere(volume.dims, volume.world_from_voxel);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(spacing[axis] * static_cast<double>(size[axis]), kAngiogramExtentMm[axis], 1e-9);
      EXPECT_NEAR(sphere.center_mm[axis], 0.0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace nacre

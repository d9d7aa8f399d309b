#include "datasets/scalar_fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "datasets/phantom.h"

namespace nacre {
namespace {

TEST(Hipip, IsSymmetricAboutTwoPlanes) {
  for (const glm::dvec3 p : {glm::dvec3(3, 5, 7), glm::dvec3(12, -1, -9), glm::dvec3(20, 8, -15)}) {
    EXPECT_EQ(hipip_value(p), hipip_value({-p.x, p.y, p.z}));
    EXPECT_EQ(hipip_value(p), hipip_value({p.x, -p.y, p.z}));
  }
}

TEST(Hipip, HasLobesOfBothSignsUpToItsBounds) {
  const Volume volume = make_phantom("hipip");
  const auto samples = samples_as<std::int16_t>(volume);
  EXPECT_EQ(*std::ranges::min_element(samples), -255);
  EXPECT_EQ(*std::ranges::max_element(samples), 255);
  const auto positive = std::ranges::count_if(samples, [](std::int16_t v) { return v > 50; });
  const auto negative = std::ranges::count_if(samples, [](std::int16_t v) { return v < -50; });
  EXPECT_GT(positive, 20'000);
  EXPECT_NEAR(static_cast<double>(positive) / static_cast<double>(negative), 1.0, 0.2);
}

// Central differences of second order, a small step against the plume's millimetres and seconds.
TEST(Plume, SolvesTheAdvectionDispersionEquation) {
  constexpr double h = 0.5;
  const auto value = [](const glm::dvec3& p, double t) {
    return PlumeField{.last_release_age_s = t}.value(p);
  };
  for (const glm::dvec3 p :
       {glm::dvec3(-15, 5, -100), glm::dvec3(10, 0, 0), glm::dvec3(20, -20, 120)}) {
    constexpr double time_s = 40.0;
    const auto second = [&](const glm::dvec3& step) {
      const double sides = value(p + step, time_s) + value(p - step, time_s);
      return (sides - 2.0 * value(p, time_s)) / (h * h);
    };
    const glm::dvec3 along(0, 0, h);
    const double rate = (value(p, time_s + h) - value(p, time_s - h)) / (2.0 * h);
    const double advection = (value(p + along, time_s) - value(p - along, time_s)) / (2.0 * h);
    const PlumeField field;
    const double dispersion = field.along_mm2_s * second(along) +
                              field.across_mm2_s * (second({h, 0, 0}) + second({0, h, 0}));
    const double residual = rate + field.velocity_mm_s * advection - dispersion;
    EXPECT_NEAR(residual, 0.0, 1e-3 * std::abs(dispersion) + 1e-6);
  }
}

TEST(Plume, PeaksNearAHundredAndNowhereBelowZero) {
  const Volume volume = make_phantom("plume");
  const auto samples = samples_as<float>(volume);
  EXPECT_GE(*std::ranges::min_element(samples), 0.0f);
  EXPECT_NEAR(*std::ranges::max_element(samples), 100.0f, 10.0f);
}

}  // namespace
}  // namespace nacre

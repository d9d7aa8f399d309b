#include "datasets/closed_forms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

namespace nacre {
namespace {

constexpr double kRounding = 1e-11;  // values up to 1000, a few operations

const Ray kSlanted{{3.0, -5.0, 2.0}, glm::normalize(glm::dvec3(1.0, 0.7, -0.4))};

using Field = std::function<double(const glm::dvec3&)>;

/// Largest value and midpoint-rule integral along a line, by dense sampling.
struct Sampled {
  double maximum;
  double integral;
};

Sampled march(const Field& field, const Ray& line, double from_mm, double to_mm) {
  constexpr int steps = 200'000;
  const double step_mm = (to_mm - from_mm) / steps;
  Sampled sampled{-1e300, 0.0};
  for (int i = 0; i < steps; ++i) {
    const double value = field(line.origin_mm + (from_mm + (i + 0.5) * step_mm) * line.direction);
    sampled.maximum = std::max(sampled.maximum, value);
    sampled.integral += value * step_mm;
  }
  return sampled;
}

TEST(SphereField, ProjectionsAreTheMarchedOnes) {
  const SphereField field;
  const Sampled marched =
      march([&](const glm::dvec3& p) { return field.value(p); }, kSlanted, -40.0, 40.0);
  EXPECT_NEAR(field.maximum(kSlanted), marched.maximum, 1e-6);
  EXPECT_NEAR(field.integral(kSlanted), marched.integral, 1e-5);
}

TEST(SphereField, ThroughTheCenterAndBeside) {
  const SphereField field;
  const Ray through{{-50.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  EXPECT_DOUBLE_EQ(field.maximum(through), 28.0);
  EXPECT_DOUBLE_EQ(field.integral(through), 28.0 * 28.0);  // a triangle
  EXPECT_DOUBLE_EQ(field.chord_mm(through, 8.0), 40.0);
  const Ray beside{{0.0, 28.5, 0.0}, {1.0, 0.0, 0.0}};
  EXPECT_EQ(field.maximum(beside), 0.0);
  EXPECT_EQ(field.integral(beside), 0.0);
  EXPECT_EQ(field.chord_mm(beside, 1.0), 0.0);
}

TEST(SphereField, LevelSurfaceHasItsRadius) {
  const SphereField field;
  const glm::dvec3 direction = glm::normalize(glm::dvec3(1.0, -2.0, 3.0));
  EXPECT_NEAR(field.value(field.level_radius_mm(10.0) * direction), 10.0, kRounding);
}

TEST(TorusField, MaximaAlongTheAxesAreTheMarchedOnes) {
  const TorusField field;
  const Field value = [&](const glm::dvec3& p) { return field.value(p); };
  for (const double a : {0.0, 7.0, 18.0, 24.5}) {
    for (const double b : {0.0, 4.0, -6.5}) {
      const Ray along_x{{0.0, a, b}, {1.0, 0.0, 0.0}};
      EXPECT_NEAR(field.maximum_along_x(a, b), march(value, along_x, -40, 40).maximum, 1e-3);
      const Ray along_z{{a, b, 0.0}, {0.0, 0.0, 1.0}};
      EXPECT_NEAR(field.maximum_along_z(a, b), march(value, along_z, -40, 40).maximum, 1e-3);
    }
  }
}

TEST(TorusField, IsTheSignedDistanceToTheTorus) {
  const TorusField field;
  EXPECT_NEAR(field.value({18.0, 0.0, 0.0}), 8.0, kRounding);   // the tube's centre
  EXPECT_NEAR(field.value({0.0, -26.0, 0.0}), 0.0, kRounding);  // on its outside
  EXPECT_NEAR(field.value({0.0, 0.0, 0.0}), -10.0, kRounding);  // in the hole
}

// The volume between two levels is the area of the levels integrated over the distance.
TEST(TorusField, AreaIsTheVolumesDerivative) {
  const TorusField field;
  constexpr double step = 1e-4;
  const double difference = field.level_volume_mm3(2.0 - step) - field.level_volume_mm3(2.0 + step);
  EXPECT_NEAR(difference / (2 * step), field.level_area_mm2(2.0), 1e-5);
}

TEST(QuadraticField, ProjectionsAreTheMarchedOnes) {
  const QuadraticField field;
  const Sampled marched =
      march([&](const glm::dvec3& p) { return field.value(p); }, kSlanted, -20.0, 15.0);
  EXPECT_NEAR(field.maximum(kSlanted), marched.maximum, 1e-6);
  EXPECT_NEAR(field.integral(kSlanted, -20.0, 15.0), marched.integral, 1e-3);
}

TEST(QuadraticField, LevelSurfacesAreEllipsoids) {
  const QuadraticField field;
  const glm::dvec3 axes = field.level_semi_axes_mm(200.0);
  EXPECT_NEAR(field.value({axes.x, 0.0, 0.0}), 200.0, kRounding);
  EXPECT_NEAR(field.value({0.0, axes.y, 0.0}), 200.0, kRounding);
  EXPECT_NEAR(field.value({0.0, 0.0, axes.z}), 200.0, kRounding);
}

TEST(QuadraticField, TrilinearInterpolationOfItsSamplesIsKnown) {
  const QuadraticField field;
  const glm::dvec3 spacing_mm(0.5, 1.0, 2.0);
  const glm::dvec3 corner_mm(3.0, -7.0, 4.0);
  CellField cell{};
  for (unsigned i = 0; i < 8; ++i) {
    cell.corners[i] = field.value(corner_mm + spacing_mm * glm::dvec3(i & 1, i >> 1 & 1, i >> 2));
  }
  const glm::dvec3 fraction(0.3, 0.8, 0.55);
  EXPECT_NEAR(cell.value(fraction),
              field.trilinear_value(corner_mm + spacing_mm * fraction, spacing_mm, fraction),
              kRounding);
}

TEST(CellField, HasItsCornersAndItsMean) {
  const CellField cell{{1.0, -2.0, 3.0, 0.5, -1.5, 4.0, 0.25, 7.0}};
  for (unsigned i = 0; i < 8; ++i) {
    EXPECT_EQ(cell.value({i & 1, i >> 1 & 1, i >> 2}), cell.corners[i]);
  }
  EXPECT_DOUBLE_EQ(cell.value(glm::dvec3(0.5)), 12.25 / 8.0);
}

TEST(CellField, IsACubicAlongALine) {
  const CellField cell{{1.0, -2.0, 3.0, 0.5, -1.5, 4.0, 0.25, 7.0}};
  const glm::dvec3 origin(0.1, 0.9, 0.2);
  const glm::dvec3 direction(0.6, -0.7, 0.3);
  const std::array<double, 4> c = cell.cubic_along(origin, direction);
  for (const double t : {0.0, 0.4, 1.1}) {
    EXPECT_NEAR(c[0] + t * (c[1] + t * (c[2] + t * c[3])), cell.value(origin + t * direction),
                kRounding);
  }
}

TEST(CheckerboardField, AlternatesAndIsTrilinearBetween) {
  const CheckerboardField field;
  EXPECT_EQ(field.value({0, 0, 0}), 0.0);
  EXPECT_EQ(field.value({3, 5, 7}), 1.0);
  EXPECT_EQ(field.value({-1, 0, 0}), 1.0);
  EXPECT_EQ(field.value({2.5, 1.2, 0.3}), 0.5);  // midway along x
  const CellField cell{{0, 1, 1, 0, 1, 0, 0, 1}};
  const glm::dvec3 fraction(0.2, 0.7, 0.4);
  EXPECT_NEAR(field.value(glm::dvec3(4, 2, 6) + fraction), cell.value(fraction), kRounding);
  EXPECT_NEAR(field.value(glm::dvec3(5, 2, 6) + fraction), 1.0 - cell.value(fraction), kRounding);
}

}  // namespace
}  // namespace nacre

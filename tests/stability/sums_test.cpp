// Sums of signed crossings, drawn: order, cancellation, formats, the eye close by.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/render/gl_test_support.h"
#include "tests/stability/stability_case.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {
namespace {

const BoundingSphere kSphere{{0.0, 0.0, 0.0}, 60.0};
const CameraOptions kSmall{.size = {32, 32}, .azimuth_rad = 0.37, .elevation_rad = 0.21};

double largest_of(const Image& image) {
  return static_cast<double>(*std::ranges::max_element(image.pixels));
}

/// Largest difference of two pictures, as a part of the first's largest pixel.
double difference_of(const Image& a, const Image& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    largest = std::max(
        largest, std::abs(static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i])));
  }
  return largest / largest_of(a);
}

class SumStability : public GlTest {};

TEST_F(SumStability, AMillionMillimetresFromTheOrigin) {
  const glm::dvec3 far(1e6, -1e6, 1e6);
  const BoundingSphere there{far, kSphere.radius_mm};
  const RenderOptions sum{.mode = PictureMode::Sum};
  const Image here = draw(nested_balls(12, 50.0, 16), make_camera(kSmall, kSphere), sum);
  const Image moved = draw(nested_balls(12, 50.0, 16, far), make_camera(kSmall, there), sum);
  // A chord of 100 mm between two crossings as floats measured from the world's origin.
  constexpr double kDistance = 1.7e6;
  const double chord =
      static_cast<double>(static_cast<float>(kDistance + 100.03) - static_cast<float>(kDistance));
  expect_held({.name = "sum of shells 1.7e6 mm from the origin",
               .unit = "of the largest pixel",
               .bound = 1e-5,
               .seen = difference_of(here, moved),
               .naive = std::abs(chord - 100.03) / 100.03,
               .naive_formula = "crossings as floats from the world's origin"});
}

TEST_F(SumStability, DoesNotDependOnTheOrderOfTriangles) {
  ShellSet set = nested_balls(12, 50.0, 24);
  const Camera camera = make_camera(kSmall, kSphere);
  const auto drawn = [&](TargetFormat target) {
    return draw(set, camera, {.mode = PictureMode::Sum, .target = target});
  };
  const Image in_order = drawn(TargetFormat::F32);
  const Image half_in_order = drawn(TargetFormat::F16);
  std::mt19937 random(7);
  for (Shell& shell : set.shells) {
    std::shuffle(shell.surface.triangles.begin(), shell.surface.triangles.end(), random);
  }
  expect_held({.name = "sum, triangles shuffled",
               .unit = "of the largest pixel",
               .bound = 1e-6,
               .seen = difference_of(in_order, drawn(TargetFormat::F32)),
               .naive = difference_of(half_in_order, drawn(TargetFormat::F16)),
               .naive_formula = "adding up in half floats (--target 16f)"});
}

TEST_F(SumStability, LayersAThousandthOfAMillimetreThick) {
  constexpr double thickness = 0x1p-10;
  const ShellSet set = make_set({block_mesh({-45, -45, -45}, {45, 45, 45}),
                                 block_mesh({-44, 20, -44}, {44, 20 + thickness, 44})});
  const Camera camera = make_camera({.size = {9, 9}, .zoom = 4.0}, kSphere);
  const auto error = [&](TargetFormat target) {
    const Image image = draw(set, camera, {.mode = PictureMode::Sum, .target = target});
    return std::abs(static_cast<double>(image.at(4, 4)) - 0.5 * (90.0 + thickness));
  };
  expect_held({.name = "sum of a layer 1/1024 mm thick inside one of 90 mm",
               .unit = "mm",
               .bound = 4.0 * 90.0 * 0x1p-24,  // a float's rounding a crossing, at the worst
               .seen = error(TargetFormat::F32),
               .naive = error(TargetFormat::F16),
               .naive_formula = "adding up in half floats (--target 16f)"});
}

TEST_F(SumStability, TheEyeAHundredthOfAMillimetreFromASurface) {
  constexpr double front = -20.0;
  constexpr double gap = 0.01;
  const ShellSet set = make_set({block_mesh({-45, front, -45}, {45, 30, 45})});
  const Camera camera =
      make_camera({.size = {9, 9}, .field_of_view_rad = 0.5, .distance_mm = -front + gap}, kSphere);
  const Image image = draw(set, camera, {.mode = PictureMode::Sum});
  // The back's eye depth from a depth buffer of 24 bits between `gap` and 120 mm.
  constexpr double far = 120.0;
  const double back = 50.0 + gap;
  const double stored = (1.0 / gap - 1.0 / back) / (1.0 / gap - 1.0 / far);
  const double read = std::round(stored * 16777215.0) / 16777215.0;
  const double naive = 1.0 / (1.0 / gap - read * (1.0 / gap - 1.0 / far));
  expect_held({.name = "sum, the eye 0.01 mm before a surface",
               .unit = "mm of 50",
               .bound = 2e-4,
               .seen = std::abs(static_cast<double>(image.at(4, 4)) - 50.0),
               .naive = std::abs(naive - back),
               .naive_formula = "depths read back from a 24-bit depth buffer"});
}

/// Nested blocks seen straight on: n layers, each adding 1/n.
ShellSet many_layers(int layers) {
  std::vector<TriangleMesh> surfaces;
  for (int k = 0; k < layers; ++k) {
    const double inwards = 15.0 * k / layers;
    surfaces.push_back(block_mesh({-45, -20 + inwards, -45}, {45, 30 - inwards, 45}));
  }
  return make_set(std::move(surfaces));
}

#ifdef NDEBUG
constexpr int kLayers = 10'000;
#else
constexpr int kLayers = 1'000;  // checked builds take their time
#endif

TEST_F(SumStability, TenThousandLayersAddUp) {
  const ShellSet set = many_layers(kLayers);
  const Camera camera = make_camera({.size = {3, 3}, .zoom = 4.0}, kSphere);
  const auto error = [&](const RenderOptions& options, double truth) {
    const Image image = draw(set, camera, options);
    return std::abs(static_cast<double>(image.at(1, 1)) - truth) / truth;
  };
  long double sum = 0.0L;
  long double count = 0.0L;
  for (int k = 0; k < kLayers; ++k) {
    sum += (50.0L - 30.0L * k / kLayers) / kLayers;
    count += 2.0L * (k + 1) / kLayers;
  }
  const std::string layers = std::to_string(kLayers) + " layers";
  const double unit = kLayers * 0x1p-24;  // a float's rounding a crossing, at the worst
  expect_held({.name = "sum of " + layers,
               .unit = "relative",
               .bound = 4.0 * unit,
               .seen = error({.mode = PictureMode::Sum}, static_cast<double>(sum)),
               .naive = error({.mode = PictureMode::Sum, .target = TargetFormat::F16},
                              static_cast<double>(sum)),
               .naive_formula = "adding up in half floats (--target 16f)"});
  expect_held({.name = "count of " + layers,
               .unit = "relative",
               .bound = 2.0 * unit,
               .seen = error({.mode = PictureMode::Count}, static_cast<double>(count)),
               .naive = error({.mode = PictureMode::Count, .target = TargetFormat::U8},
                              static_cast<double>(count)),
               .naive_formula = "adding up in 8 bits (--target 8), as in 1996"});
}

}  // namespace
}  // namespace nacre::testing

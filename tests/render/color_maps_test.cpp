#include "render/color_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"

namespace nacre {
namespace {

constexpr int kSteps = 1000;
constexpr double kOneOf255 = 1.0 / 255.0;

/// CIE 1976 lightness L*, 0 to 100, of an sRGB colour (IEC 61966-2-1; white point D65).
double lightness(const glm::dvec3& rgb) {
  const auto linear = [](double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const double y = 0.2126 * linear(rgb.r) + 0.7152 * linear(rgb.g) + 0.0722 * linear(rgb.b);
  return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

void expect_color(std::string_view name, double brightness, const glm::dvec3& expected,
                  double tolerance = 0.5 * kOneOf255) {
  const glm::dvec3 found = ColorMap(name)(brightness);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(found[c], expected[c], tolerance) << name << " at " << brightness << ", " << c;
  }
}

bool is_perceptual(std::string_view name) {
  return name == "viridis" || name == "inferno" || name == "magma" || name == "plasma" ||
         name == "cividis";
}

TEST(ColorMaps, RiseInLightnessAllTheWay) {
  for (const std::string_view name : color_map_names()) {
    const ColorMap map(name);
    for (int i = 0; i < kSteps; ++i) {
      const double step =
          lightness(map((i + 1.0) / kSteps)) - lightness(map(static_cast<double>(i) / kSteps));
      EXPECT_GT(map.is_inverted() ? -step : step, 0.0) << name << " at " << i;
    }
  }
}

// The even rise is what they were made for: no tenth is far steeper or flatter than the whole.
TEST(ColorMaps, OfPerceptionRiseEvenlyInLightness) {
  for (const std::string_view name : color_map_names()) {
    if (!is_perceptual(name)) continue;
    const ColorMap map(name);
    const double whole = lightness(map(1.0)) - lightness(map(0.0));
    for (int i = 0; i < 10; ++i) {
      const double tenth = lightness(map((i + 1) / 10.0)) - lightness(map(i / 10.0));
      EXPECT_GT(tenth, 0.6 * whole / 10.0) << name << " at " << i;
      EXPECT_LT(tenth, 1.4 * whole / 10.0) << name << " at " << i;
    }
  }
}

TEST(ColorMaps, HaveTheirPublishedColours) {
  expect_color("gray", 0.25, glm::dvec3(0.25));
  expect_color("gray-inverted", 0.25, glm::dvec3(0.75));
  expect_color("hot", 0.5, {1.0, 0.5, 0.0});
  expect_color("hot-iron", 0.5, {1.0, 0.0, 0.0});
  expect_color("hot-iron", 0.75, {1.0, 0.5, 0.0});
  expect_color("hot-iron", 1.0, {1.0, 1.0, 1.0});
  // MATLAB's knots, as matplotlib's _cm.py lists them.
  expect_color("bone", 0.365079, {0.319444, 0.319444, 0.444444}, 1e-5);
  expect_color("bone", 0.746032, {0.652778, 0.777778, 0.777778}, 1e-5);
  expect_color("bone", 1.0, {1.0, 1.0, 1.0});
  // First, 129th and last entries of matplotlib's _cm_listed.py.
  expect_color("viridis", 0.0, {0.267004, 0.004874, 0.329415});
  expect_color("viridis", 1.0, {0.993248, 0.906157, 0.143936});
  expect_color("viridis", 128.0 / 255.0, {0.127568, 0.566949, 0.550556}, kOneOf255);
  expect_color("inferno", 0.0, {0.001462, 0.000466, 0.013866});
  expect_color("inferno", 1.0, {0.988362, 0.998364, 0.644924});
  expect_color("inferno", 128.0 / 255.0, {0.735683, 0.215906, 0.330245}, kOneOf255);
  expect_color("magma", 0.0, {0.001462, 0.000466, 0.013866});
  expect_color("magma", 1.0, {0.987053, 0.991438, 0.749504});
  expect_color("magma", 128.0 / 255.0, {0.716387, 0.214982, 0.47529}, kOneOf255);
  expect_color("plasma", 0.0, {0.050383, 0.029803, 0.527975});
  expect_color("plasma", 1.0, {0.940015, 0.975158, 0.131326});
  expect_color("plasma", 128.0 / 255.0, {0.798216, 0.280197, 0.469538}, kOneOf255);
  expect_color("cividis", 0.0, {0.0, 0.135112, 0.304751});
  expect_color("cividis", 1.0, {0.995737, 0.909344, 0.217772});
  expect_color("cividis", 128.0 / 255.0, {0.488697, 0.485318, 0.471008}, kOneOf255);
}

TEST(ColorMaps, StayWithinTheirRangeAndDoNotJump) {
  for (const std::string_view name : color_map_names()) {
    const ColorMap map(name);
    for (int i = 0; i < kSteps; ++i) {
      const glm::dvec3 here = map(static_cast<double>(i) / kSteps);
      const glm::dvec3 next = map((i + 1.0) / kSteps);
      for (int c = 0; c < 3; ++c) {
        EXPECT_GE(here[c], 0.0) << name;
        EXPECT_LE(here[c], 1.0) << name;
        EXPECT_LT(std::abs(next[c] - here[c]), 0.02) << name;
      }
      EXPECT_EQ(map.is_gray(), map.is_gray() && here.r == here.g && here.g == here.b);
    }
  }
}

TEST(ColorMaps, AreListedWhereOneIsUnknown) {
  try {
    ColorMap map("jet");
    FAIL() << "expected nacre::Error";
  } catch (const Error& error) {
    for (const std::string_view name : color_map_names()) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << name;
    }
  }
}

}  // namespace
}  // namespace nacre

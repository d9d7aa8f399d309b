// The z-remap in OpenGL's own depth buffers, drawn and read back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/render/gl_test_support.h"
#include "tests/stability/depth_formats.h"
#include "tests/stability/stability_case.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {
namespace {

const BoundingSphere kSphere{{0.0, 0.0, 0.0}, 60.0};
constexpr double kOutermost = 45.0;  ///< half the side of the first block, mm
constexpr double kRing = 4.0;        ///< how far the next one is smaller on each side
constexpr double kDeeper = 3.0;      ///< and how much deeper its front lies

/// Blocks within each other, seen straight on: the front of each shows as a ring about the next's.
class DepthBuffers : public GlTest {
 protected:
  static double front_mm(std::size_t block) { return -30.0 + kDeeper * static_cast<double>(block); }

  static ShellSet blocks(const std::vector<double>& emissions) {
    std::vector<TriangleMesh> surfaces;
    for (std::size_t k = 0; k < emissions.size(); ++k) {
      const double side = kOutermost - kRing * static_cast<double>(k);
      surfaces.push_back(block_mesh({-side, front_mm(k), -side}, {side, side, side}));
    }
    ShellSet set = make_set(std::move(surfaces));
    for (std::size_t k = 0; k < emissions.size(); ++k) set.shells[k].representative = emissions[k];
    return set;
  }

  static Camera camera() { return make_camera({.size = {64, 64}}, kSphere); }

  /// What the picture shows in the middle of each ring.
  static std::vector<double> rings(const std::vector<double>& emissions,
                                   const RenderOptions& options) {
    const Image image = draw(blocks(emissions), camera(), options);
    std::vector<double> shown;
    for (std::size_t k = 0; k < emissions.size(); ++k) {
      const double x = kOutermost - kRing * (static_cast<double>(k) + 0.5);
      const int column = static_cast<int>(32.0 + 32.0 * x / kSphere.radius_mm);
      shown.push_back(static_cast<double>(image.at(column, 32)));
    }
    return shown;
  }

  /// Largest relative error of an uncued maximum.
  static double error(const std::vector<double>& emissions, DepthFormat format) {
    const std::vector<double> shown = rings(emissions, {.depth = format});
    double largest = 0.0;
    for (std::size_t k = 0; k < emissions.size(); ++k) {
      largest = std::max(largest, std::abs(shown[k] - emissions[k]) / emissions[k]);
    }
    return largest;
  }

  /// The cued maximum behind the middle of each ring: fronts are the nearest.
  static std::vector<double> cued(const std::vector<double>& emissions, const DepthCue& cue) {
    std::vector<double> truth;
    double brightest = 0.0;
    for (std::size_t k = 0; k < emissions.size(); ++k) {
      const double z = depth_z(camera(), {0.0, front_mm(k), 0.0});
      brightest = std::max(brightest, beta(cue, z) * emissions[k]);
      truth.push_back(brightest);
    }
    return truth;
  }
};

TEST_F(DepthBuffers, HoldEmissionsFromTenMillionthsToOne) {
  const std::vector<double> emissions{1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 1.0};
  for (const DepthFormat format : kFormats) {
    expect_held({.name = "drawn: maximum of emissions from 1e-7 to 1, " + format_words(format),
                 .unit = "relative",
                 .bound = 0x1p-24,  // the picture is of floats
                 .seen = error(emissions, format),
                 .naive = emission_as_depth_error(emissions, format),
                 .naive_formula = "emission as depth in OpenGL's usual clip range"});
  }
}

TEST_F(DepthBuffers, KeepEmissionsOneUlpApart) {
  std::vector<double> emissions{static_cast<double>(0.001F)};
  for (int i = 0; i < 3; ++i) {
    emissions.push_back(
        static_cast<double>(std::nextafter(static_cast<float>(emissions.back()), 1.0F)));
  }
  const double ulp = (emissions[1] - emissions[0]) / emissions[0];
  for (const DepthFormat format : kFormats) {
    expect_held({.name = "drawn: maximum of emissions one ulp apart, " + format_words(format),
                 .unit = "ulps of a float",
                 .bound = 0.0,
                 .seen = error(emissions, format) / ulp,
                 .naive = emission_as_depth_error(emissions, format) / ulp,
                 .naive_formula = "emission as depth in OpenGL's usual clip range"});
  }
}

/// Half a step, and a few roundings of OpenGL's floats on the way: each up to a step of 24 bits.
double bound_of(DepthFormat format) {
  constexpr double kRoundings = 1.5;
  switch (format) {
    case DepthFormat::D16: return 0.5 + kRoundings * 0x1p-8;
    case DepthFormat::D24: return 0.5 + kRoundings;
    case DepthFormat::D32F: break;
  }
  return 4.0 * 0x1p-24;
}

TEST_F(DepthBuffers, HoldCuesWhoseSlopeIsFromNothingToAMillionTimesTheirBase) {
  const std::vector<double> emissions{1e-4, 0.01, 0.3, 1.0};
  for (const DepthFormat format : kFormats) {
    double seen = 0.0;
    double naive = 1e300;
    for (const double ratio : {1e-6, 1e-3, 0.1, 1.0, 10.0, 1e3, 1e6}) {
      const DepthCue cue{.a = ratio * 0.7, .b = 0.7};
      const double beta_max = beta(cue, 1.0);
      const std::vector<double> truth = cued(emissions, cue);
      const std::vector<double> shown = rings(emissions, {.cue = cue, .depth = format});
      double worst = 0.0;
      for (std::size_t k = 0; k < emissions.size(); ++k) {
        const double steps = format == DepthFormat::D16 ? 65535.0 : 16777215.0;
        const double allowed = format == DepthFormat::D32F ? truth[k] : beta_max / steps;
        seen = std::max(seen, std::abs(shown[k] - truth[k]) / allowed);
        const double plain = stored_by_default(format, truth[k] / beta_max) * beta_max;
        const double doubled = stored(format, 2.0 * truth[k] / beta_max) * beta_max;
        const double wrong = format == DepthFormat::D32F ? plain : doubled;
        worst = std::max(worst, std::abs(wrong - truth[k]) / allowed);
      }
      naive = std::min(naive, worst);
    }
    expect_held({.name = "drawn: cued maximum, a/b from 1e-6 to 1e6, " + format_words(format),
                 .unit = format == DepthFormat::D32F ? "relative" : "steps",
                 .bound = bound_of(format),
                 .seen = seen,
                 .naive = naive,
                 .naive_formula = format == DepthFormat::D32F
                                      ? "OpenGL's usual clip range"
                                      : "dividing by something else than the largest beta"});
  }
}

}  // namespace
}  // namespace nacre::testing

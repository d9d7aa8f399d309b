// [H96]'s z-remap: emission in the place of depth, in buffers of 16, 24 and 32 bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "render/plan.h"
#include "tests/stability/depth_formats.h"
#include "tests/stability/stability_case.h"

namespace nacre::testing {
namespace {

/// Shells of these representatives, each within the one before.
SceneFacts nested(const std::vector<double>& representatives) {
  SceneFacts facts;
  double half_side = 30.0;
  for (const double representative : representatives) {
    facts.shells.push_back({representative, 12, {glm::dvec3(-half_side), glm::dvec3(half_side)}});
    half_side *= 0.99;
  }
  return facts;
}

Plan plan_of(const std::vector<double>& representatives, DepthFormat format,
             const DepthCue& cue = {}) {
  const BoundingSphere sphere{{0.0, 0.0, 0.0}, 60.0};
  return make_plan(nested(representatives), make_camera({}, sphere), {.cue = cue, .depth = format});
}

/// The emission that the picture shows for a depth read back, uncued.
double emission_of(const Plan& plan, double depth) {
  const auto ranks = static_cast<double>(plan.emission_of_rank.size() - 1);
  return static_cast<double>(
      plan.emission_of_rank[static_cast<std::size_t>(std::lround(depth * ranks))]);
}

/// Largest relative error over the shells, uncued.
double rank_error(const std::vector<double>& representatives, DepthFormat format) {
  const Plan plan = plan_of(representatives, format);
  double largest = 0.0;
  for (const ShellDraw& draw : plan.passes.front().draws) {
    const double truth = representatives[draw.shell];
    const double shown = emission_of(plan, stored(format, draw.depth_at_near));
    largest = std::max(largest, std::abs(shown - truth) / truth);
  }
  return largest;
}

TEST(DepthRemap, HoldsEmissionsFromTenMillionthsToOne) {
  const std::vector<double> emissions{1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 1.0};
  for (const DepthFormat format : kFormats) {
    expect_held({.name = "maximum of emissions from 1e-7 to 1, " + format_words(format),
                 .unit = "relative",
                 .bound = 0x1p-24,  // the picture is of floats
                 .seen = rank_error(emissions, format),
                 .naive = emission_as_depth_error(emissions, format),
                 .naive_formula = "emission as depth in OpenGL's usual clip range"});
  }
}

TEST(DepthRemap, KeepsEmissionsOneUlpApart) {
  std::vector<double> emissions{0.001};
  for (int i = 0; i < 3; ++i) {
    emissions.push_back(
        static_cast<double>(std::nextafter(static_cast<float>(emissions.back()), 1.0F)));
  }
  emissions.front() = static_cast<double>(static_cast<float>(emissions.front()));
  const double ulp = (emissions[1] - emissions[0]) / emissions[0];
  for (const DepthFormat format : kFormats) {
    expect_held({.name = "maximum of emissions one ulp apart, " + format_words(format),
                 .unit = "ulps of a float",
                 .bound = 0.0,
                 .seen = rank_error(emissions, format) / ulp,
                 .naive = emission_as_depth_error(emissions, format) / ulp,
                 .naive_formula = "emission as depth in OpenGL's usual clip range"});
  }
}

/// Errors of a cued maximum over shells and depths z, in units of the format's promise: a step's
/// half of 2^16 or 2^24 over beta_max, or a float's 2^-24 of the value itself.
struct CuedError {
  double seen = 0.0;
  double naive = 0.0;
};

CuedError cued_error(const DepthCue& cue, DepthFormat format) {
  const std::vector<double> emissions{1e-4, 0.01, 0.3, 1.0};
  const Plan plan = plan_of(emissions, format, cue);
  const double beta_max = std::max(beta(cue, 0.0), beta(cue, 1.0));
  CuedError error;
  for (const ShellDraw& draw : plan.passes.front().draws) {
    for (int i = 0; i <= 100; ++i) {
      const double z = i / 100.0;
      const double truth = beta(cue, z) * emissions[draw.shell];
      const double depth = draw.depth_at_far + z * (draw.depth_at_near - draw.depth_at_far);
      const double allowed =
          format == DepthFormat::D32F
              ? 0x1p-24 * truth
              : 0.5 * beta_max / (format == DepthFormat::D16 ? 65535.0 : 16777215.0);
      const double shown = stored(format, depth) * plan.depth_scale;
      // Not divided by the largest beta: what is above 1 is clamped.
      const double naive = format == DepthFormat::D32F
                               ? stored_by_default(format, truth / beta_max) * beta_max
                               : stored(format, truth * 2.0 / beta_max) * beta_max;
      error.seen = std::max(error.seen, std::abs(shown - truth) / allowed);
      error.naive = std::max(error.naive, std::abs(naive - truth) / allowed);
    }
  }
  return error;
}

TEST(DepthRemap, HoldsCuesWhoseSlopeIsFromNothingToAMillionTimesTheirBase) {
  for (const DepthFormat format : kFormats) {
    CuedError worst;
    worst.naive = 1e300;
    for (const double ratio : {1e-6, 1e-3, 0.1, 1.0, 10.0, 1e3, 1e6}) {
      const CuedError error = cued_error({.a = ratio * 0.7, .b = 0.7}, format);
      worst.seen = std::max(worst.seen, error.seen);
      worst.naive = std::min(worst.naive, error.naive);
    }
    expect_held({.name = "cued maximum, a/b from 1e-6 to 1e6, " + format_words(format),
                 .unit = format == DepthFormat::D32F ? "2^-24 of the value" : "half steps",
                 .bound = 1.0 + 1e-6,  // and the roundings of doubles on the way
                 .seen = worst.seen,
                 .naive = worst.naive,
                 .naive_formula = format == DepthFormat::D32F
                                      ? "OpenGL's usual clip range"
                                      : "dividing by something else than the largest beta"});
  }
}

TEST(DepthRemap, ACueWithoutSlopeKeepsRanks) {
  const DepthCue flat{.a = 0.0, .b = 1e-6};
  for (const DepthFormat format : kFormats) {
    const Plan plan = plan_of({1e-7, 1.0}, format, flat);
    double largest = 0.0;
    double naive = 0.0;
    for (const ShellDraw& draw : plan.passes.front().draws) {
      const double truth = 1e-6 * (draw.shell == 0 ? 1e-7 : 1.0);
      const double shown = emission_of(plan, stored(format, draw.depth_at_near));
      largest = std::max(largest, std::abs(shown - truth) / truth);
      naive = std::max(naive, std::abs(stored_by_default(format, truth) - truth) / truth);
    }
    expect_held({.name = "maximum under a cue of a = 0, b = 1e-6, " + format_words(format),
                 .unit = "relative",
                 .bound = 0x1p-24,
                 .seen = largest,
                 .naive = naive,
                 .naive_formula = "cued emission as depth"});
  }
}

TEST(DepthRemap, RefusesMoreShellsThanAFormatKeepsApart) {
  std::vector<double> emissions;
  for (int i = 1; i <= (1 << 14) + 1; ++i) emissions.push_back(i / 20000.0);
  EXPECT_THROW(plan_of(emissions, DepthFormat::D16), Error);
  emissions.pop_back();
  EXPECT_EQ(rank_error(emissions, DepthFormat::D24) <= 0x1p-24, true);
}

}  // namespace
}  // namespace nacre::testing

#include "shells/build.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "core/error.h"
#include "core/quantization_grid.h"
#include "shells/shell_checks.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::random_volume;
using testing::volume_of;

constexpr double kRadius = 12.0;

/// A ball whose value falls linearly from 200 at the centre to 0 at the radius.
Volume ball() {
  Volume volume =
      volume_of<float>({32, 32, 32}, [](std::int64_t i, std::int64_t j, std::int64_t k) {
        const double r = glm::distance(glm::dvec3(i, j, k), glm::dvec3(15.3, 15.6, 15.9));
        return std::max(0.0, 200.0 * (1.0 - r / kRadius));
      });
  volume.world_from_voxel = glm::translate(glm::dmat4(1.0), {100.0, -200.0, 300.0});
  return volume;
}

void expect_sound(const ShellSet& set) {
  for (std::size_t k = 0; k < set.shells.size(); ++k) {
    EXPECT_TRUE(check_shell(set.shells[k].surface).is_sound()) << "shell " << k;
    for (const glm::vec3& p : set.shells[k].surface.positions) ASSERT_TRUE(is_on(*set.grid, p));
  }
}

TEST(Levels, UniformOnesFollowTheMidpointRule) {
  const std::vector<Level> levels = uniform_levels(4);
  ASSERT_EQ(levels.size(), 4u);
  EXPECT_DOUBLE_EQ(levels[0].emission, 0.125);
  EXPECT_DOUBLE_EQ(levels[3].emission, 0.875);
  EXPECT_DOUBLE_EQ(levels[0].representative, 0.25);
  EXPECT_DOUBLE_EQ(levels[3].representative, 1.0);
  EXPECT_THROW(uniform_levels(0), Error);
}

TEST(Levels, ExplicitOnesShowTheMiddleOfTheirLayer) {
  const std::vector<Level> levels = explicit_levels(std::vector<double>{0.2, 0.6, 0.7});
  EXPECT_DOUBLE_EQ(levels[0].representative, 0.4);
  EXPECT_DOUBLE_EQ(levels[2].representative, 1.0);
  EXPECT_THROW(explicit_levels(std::vector<double>{0.2, 0.2}), Error);
  EXPECT_THROW(explicit_levels(std::vector<double>{0.0}), Error);
  EXPECT_THROW(explicit_levels(std::vector<double>{1.1}), Error);
  EXPECT_THROW(explicit_levels(std::vector<double>{std::nan("")}), Error);
}

TEST(Build, ShellsOfABallAreSpheres) {
  BuildOptions options;
  options.levels = uniform_levels(5);
  const BuiltShells built = build_shells(ball(), EmissionMap::window(0, 200), options);
  expect_sound(built.set);
  for (const Shell& shell : built.set.shells) {
    const double radius = kRadius * (1.0 - shell.emission);
    const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
    // Contouring's second-order error; the smallest sphere is a voxel across.
    EXPECT_NEAR(std::cbrt(check_shell(shell.surface).volume_mm3 / volume), 1.0, 0.2 / radius);
  }
  EXPECT_EQ(built.set.center_mm, glm::dvec3(115.5, -184.5, 315.5));
}

TEST(Build, SimplifiesWithinTheTolerance) {
  BuildOptions options;
  options.levels = uniform_levels(5);
  options.emission_tolerance = 0.02;
  const BuiltShells built = build_shells(ball(), EmissionMap::window(0, 200), options);
  expect_sound(built.set);
  EXPECT_LT(built.report.triangles, built.report.extracted_triangles / 2);
}

// Small tolerances, up to 0.05 at the mean slope, are simplified by passes before the queue;
// weighted ones are a third of themselves there.
TEST(Build, KeepsVolumesInsideOnBothSidesOfPassesOverTheEdges) {
  for (const ToleranceWeight weight : {ToleranceWeight::Field, ToleranceWeight::Picture}) {
    const double at_mean_slope = weight == ToleranceWeight::Field ? 1.0 : 3.0;
    std::size_t finer = 1'000'000;
    for (const double tolerance : {0.02, 0.05, 0.051, 0.1}) {
      BuildOptions options;
      options.levels = uniform_levels(4);
      options.emission_tolerance = tolerance * at_mean_slope;
      options.tolerance_weight = weight;
      const BuiltShells built = build_shells(ball(), EmissionMap::window(0, 200), options);
      expect_sound(built.set);
      EXPECT_EQ(built.set.tolerance_weight, weight);
      EXPECT_LT(built.report.triangles, finer) << name(weight) << ' ' << tolerance;
      finer = built.report.triangles + built.report.triangles / 10;
      for (const Shell& shell : built.set.shells) {
        const double radius = kRadius * (1.0 - shell.emission);
        if (radius < 3.0) continue;  // a few voxels across: nothing but its tip
        const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
        // A radius off by the tolerance everywhere would be off by `tolerance * kRadius`: volumes
        // are kept to two fifths of that, and to contouring's second order.
        EXPECT_NEAR(std::cbrt(check_shell(shell.surface).volume_mm3 / volume), 1.0,
                    (0.4 * tolerance * kRadius + 0.1) / radius)
            << name(weight) << ' ' << tolerance << ' ' << shell.emission;
      }
    }
  }
}

TEST(Build, StatesAWeightOfATolerance) {
  BuildOptions options;
  options.levels = uniform_levels(3);
  options.tolerance_weight = ToleranceWeight::Picture;
  options.tolerance_mm = 0.5;
  const BuiltShells built = build_shells(ball(), EmissionMap::window(0, 200), options);
  EXPECT_EQ(built.set.tolerance_weight, ToleranceWeight::Field);
}

TEST(Build, SharesATargetOut) {
  BuildOptions options;
  options.levels = uniform_levels(5);
  options.target_triangles = 1000;
  const BuiltShells built = build_shells(ball(), EmissionMap::window(0, 200), options);
  expect_sound(built.set);
  EXPECT_LE(built.report.triangles, 1000u);
  EXPECT_GE(built.report.triangles, 900u);
}

TEST(Build, ALevelThatNothingReachesIsEmpty) {
  BuildOptions options;
  options.levels = explicit_levels(std::vector<double>{0.5, 1.0});
  const BuiltShells built = build_shells(ball(), EmissionMap::window(0, 400), options);
  EXPECT_TRUE(built.set.shells[1].surface.triangles.empty());
}

TEST(Build, NoiseStaysSound) {
  BuildOptions options;
  options.levels = uniform_levels(7);  // integers among the levels: samples equal to them
  for (const double tolerance : {0.0, 0.1}) {
    options.emission_tolerance = tolerance;
    const Volume noise = random_volume<std::uint8_t>({8, 9, 10}, 0, 14);
    expect_sound(build_shells(noise, EmissionMap::window(0, 14), options).set);
  }
}

TEST(Build, ExtremeSpacingsStaySound) {
  BuildOptions options;
  options.levels = uniform_levels(3);
  Volume volume = random_volume<float>({12, 12, 12}, 0, 1);
  for (const glm::dvec3 spacing : {glm::dvec3(1, 1, 1000), glm::dvec3(1e-6), glm::dvec3(1e6)}) {
    volume.world_from_voxel = glm::scale(glm::dmat4(1.0), spacing);
    expect_sound(build_shells(volume, EmissionMap::window(0, 1), options).set);
  }
}

TEST(Build, CoarseGridsStaySound) {
  BuildOptions options;
  options.levels = uniform_levels(3);
  options.quantization_bits = 7;
  const BuiltShells built = build_shells(ball(), EmissionMap::window(0, 200), options);
  expect_sound(built.set);
  EXPECT_TRUE(built.report.is_grid_coarse);
}

TEST(Build, IsTheSameForAnyNumberOfThreads) {
  BuildOptions options;
  options.levels = uniform_levels(6);
  options.emission_tolerance = 0.05;
  const Volume volume = ball();
  const EmissionMap emission = EmissionMap::window(0, 200);
  const ShellSet many = build_shells(volume, emission, options).set;
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const ShellSet single = build_shells(volume, emission, options).set;
  for (std::size_t k = 0; k < many.shells.size(); ++k) {
    EXPECT_EQ(many.shells[k].surface.positions, single.shells[k].surface.positions);
    EXPECT_EQ(many.shells[k].surface.triangles, single.shells[k].surface.triangles);
  }
}

TEST(Build, GivesTheSameShellsOneByOne) {
  BuildOptions options;
  options.levels = explicit_levels(std::vector<double>{0.1, 0.3, 0.5, 1.0});
  const EmissionMap emission = EmissionMap::window(0, 400);
  for (const double tolerance : {0.0, 0.05}) {
    options.emission_tolerance = tolerance;
    options.scratch_folder = std::nullopt;
    const BuiltShells whole = build_shells(ball(), emission, options);
    options.scratch_folder = std::filesystem::temp_directory_path();
    std::vector<TriangleMesh> taken(4);
    const BuiltShells emptied = build_shells(
        ball(), emission, options,
        [&](const ShellSet&, std::size_t k, TriangleMesh&& mesh) { taken[k] = std::move(mesh); });
    EXPECT_EQ(emptied.report.triangles, whole.report.triangles);
    for (std::size_t k = 0; k < taken.size(); ++k) {
      EXPECT_TRUE(emptied.set.shells[k].surface.triangles.empty());
      EXPECT_EQ(taken[k].positions, whole.set.shells[k].surface.positions);
      EXPECT_EQ(taken[k].triangles, whole.set.shells[k].surface.triangles);
    }
  }
}

TEST(Build, TellsItsProgress) {
  BuildOptions options;
  options.levels = uniform_levels(2);
  options.emission_tolerance = 0.05;
  std::set<std::string> stages;
  options.progress = [&](std::string_view stage, double) { stages.emplace(stage); };
  build_shells(ball(), EmissionMap::window(0, 200), options);
  EXPECT_EQ(stages, (std::set<std::string>{"extract", "simplify", "snap"}));
}

BuildOptions with_copies(std::size_t above_triangles) {
  BuildOptions options;
  options.levels = uniform_levels(4);
  options.emission_tolerance = 0.01;
  options.coarse_tolerance = 0.08;
  options.coarse_above_triangles = above_triangles;
  return options;
}

// The ball's value falls linearly, so that where a vertex lies says its emission.
TEST(Build, CoarseCopiesAreClosedOnTheGridAndWithinTheirTolerance) {
  const BuiltShells built = build_shells(ball(), EmissionMap::window(0, 200), with_copies(0));
  const glm::dvec3 centre = glm::dvec3(15.3, 15.6, 15.9) - glm::dvec3(15.5);
  ASSERT_EQ(built.copies.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    const TriangleMesh& copy = built.copies[k];
    EXPECT_TRUE(check_shell(copy).is_sound()) << "shell " << k;
    EXPECT_LT(copy.triangles.size(), built.set.shells[k].surface.triangles.size() / 2);
    for (const glm::vec3& p : copy.positions) {
      ASSERT_TRUE(is_on(*built.set.grid, p));
      const double emission = 1.0 - glm::distance(glm::dvec3(p), centre) / kRadius;
      EXPECT_NEAR(emission, built.set.shells[k].emission, 0.08 + 0.02);  // and interpolation's
    }
  }
}

TEST(Build, CoarseCopiesLeaveTheShellsAsTheyAre) {
  const EmissionMap emission = EmissionMap::window(0, 200);
  const BuiltShells plain = build_shells(ball(), emission, with_copies(1'000'000));
  const BuiltShells built = build_shells(ball(), emission, with_copies(0));
  EXPECT_TRUE(plain.copies.empty());
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(plain.set.shells[k].surface.positions, built.set.shells[k].surface.positions);
    EXPECT_EQ(plain.set.shells[k].surface.triangles, built.set.shells[k].surface.triangles);
  }
}

TEST(Build, CoarseCopiesAreTheSameForAnyNumberOfThreads) {
  const EmissionMap emission = EmissionMap::window(0, 200);
  const BuiltShells many = build_shells(ball(), emission, with_copies(0));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const BuiltShells single = build_shells(ball(), emission, with_copies(0));
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(many.copies[k].positions, single.copies[k].positions);
    EXPECT_EQ(many.copies[k].triangles, single.copies[k].triangles);
  }
}

TEST(Build, RefusesLevelsOutOfOrder) {
  BuildOptions options;
  options.levels = {{0.5, 0.5}, {0.4, 1.0}};
  EXPECT_THROW(build_shells(ball(), EmissionMap::window(0, 200), options), Error);
}

}  // namespace
}  // namespace nacre

// Simplification of contoured volumes: sound, and within its bound, for what real and extreme
// volumes bring.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdlib>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "extract/levels.h"
#include "shells/build.h"
#include "shells/certificate.h"
#include "shells/shell_checks.h"
#include "shells/trilinear_field.h"
#include "tests/support/dense_error.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

constexpr int kDense = 6;         // parts of a triangle's side
constexpr double kBetween = 1.5;  // error between samples, of the bound
constexpr double kBorderVoxels =
    0.02;  // grid points within a border plane are that far off at most

/// A vessel that bends and thins out to half a voxel, in front of a slope.
Volume vessel() {
  return testing::volume_of<float>({28, 24, 22}, [](auto i, auto j, auto k) {
    const glm::dvec3 p(i, j, k);
    const double y = 12.0 + 4.0 * std::sin(0.25 * p.x);
    const double z = 11.0 + 3.0 * std::cos(0.2 * p.x);
    const double radius = 4.5 - 0.14 * p.x;
    const double r2 = (p.y - y) * (p.y - y) + (p.z - z) * (p.z - z);
    return 20.0 + 0.8 * p.y + 200.0 * std::exp(-r2 / (radius * radius));
  });
}

/// |phi - t| off the border, where quantised caps are not exactly.
testing::PointError error_off_border(const TrilinearField& field, const LevelError& error) {
  return [&field, &error](const glm::dvec3& p_mm) {
    const glm::dvec3 p = field.voxel_from_local(p_mm);
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] < field.box().lo[axis] + kBorderVoxels) return 0.0;
      if (p[axis] > field.box().hi[axis] - kBorderVoxels) return 0.0;
    }
    return error(p_mm);
  };
}

void expect_sound(const ShellSet& set) {
  for (std::size_t k = 0; k < set.shells.size(); ++k) {
    EXPECT_TRUE(check_shell(set.shells[k].surface).is_sound()) << "shell " << k;
  }
}

BuiltShells build(const Volume& volume, const EmissionMap& emission, std::vector<Level> levels,
                  double tolerance, ToleranceWeight weight = ToleranceWeight::Field) {
  BuildOptions options;
  options.levels = std::move(levels);
  options.emission_tolerance = tolerance;
  options.tolerance_weight = weight;
  return build_shells(volume, emission, options);
}

/// Expects a tolerance to be kept, but for what contouring itself leaves.
void expect_within(double tolerance, ToleranceWeight weight) {
  const Volume volume = vessel();
  const TrilinearField field(volume);
  const EmissionMap emission = EmissionMap::window(20.0, 220.0);
  const BuiltShells plain = build(volume, emission, uniform_levels(4), 0.0);
  const BuiltShells simple = build(volume, emission, uniform_levels(4), tolerance, weight);
  expect_sound(simple.set);
  EXPECT_LT(simple.report.triangles, plain.report.triangles / 2);
  for (std::size_t k = 0; k < 4; ++k) {
    const LevelError error(field, emission, plain.set.shells[k].emission);
    const testing::PointError off_border = error_off_border(field, error);
    const double left = testing::largest_error(plain.set.shells[k].surface, off_border, kDense);
    EXPECT_LE(testing::largest_error(simple.set.shells[k].surface, off_border, kDense),
              std::max(kBetween * tolerance, left))
        << "shell " << k << ", tolerance " << tolerance;
  }
}

TEST(FieldSimplification, StaysWithinTheToleranceOrWhatContouringLeft) {
  for (const double tolerance : {0.02, 0.06}) expect_within(tolerance, ToleranceWeight::Field);
}

TEST(FieldSimplification, WeightedForPicturesItStaysWithinTheToleranceAsWell) {
  for (const double tolerance : {0.06, 0.18}) expect_within(tolerance, ToleranceWeight::Picture);
}

/// Squared error of exact maximum projections over a certificate's views.
double picture_error(const ShellSet& set, const Volume& volume, const EmissionMap& emission) {
  const CertificateOptions options{.size = {128, 128}, .maxima_only = true};
  const double rmse = certify(set, volume, emission, options).max.rmse;
  return rmse * rmse;
}

/// A steep vessel across a shallow cloud: every shell is of both.
Volume vessel_in_cloud() {
  return testing::volume_of<float>({44, 40, 36}, [](auto i, auto j, auto k) {
    const glm::dvec3 p = glm::dvec3(i, j, k) - glm::dvec3(21.5, 19.5, 17.5);
    const double across = std::hypot(p.y - 3.0 * std::sin(0.2 * p.x), p.z - 8.0);
    const double cloud = 150.0 * std::exp(-glm::dot(p, p) / (15.0 * 15.0));
    return cloud + 200.0 * std::exp(-across * across / (2.5 * 2.5));
  });
}

// A contour that is off by as much shows more where the field is shallow.
TEST(FieldSimplification, WeightedForPicturesNoMoreTrianglesShowMaximaBetter) {
  const Volume volume = vessel_in_cloud();
  const EmissionMap emission = EmissionMap::window(20.0, 220.0);
  for (const double tolerance : {0.03, 0.07}) {
    const BuiltShells even = build(volume, emission, uniform_levels(8), tolerance);
    const BuiltShells weighted =
        build(volume, emission, uniform_levels(8), 3.0 * tolerance, ToleranceWeight::Picture);
    EXPECT_LE(weighted.report.triangles, even.report.triangles);
    EXPECT_LT(picture_error(weighted.set, volume, emission),
              picture_error(even.set, volume, emission));
  }
}

/// Surface mean of the squared error.
double mean_square(const TriangleMesh& mesh, const testing::PointError& error) {
  double area = 0.0;
  double sum = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]);
    const glm::dvec3 b(mesh.positions[t.y]);
    const glm::dvec3 c(mesh.positions[t.z]);
    const double size = glm::length(glm::cross(b - a, c - a));
    int count = 0;
    double squares = 0.0;
    testing::visit_lattice(a, b, c, kDense, [&](const glm::dvec3& p) {
      squares += std::pow(error(p), 2);
      ++count;
    });
    area += size;
    sum += size * squares / count;
  }
  return sum / area;
}

// Cells where the contour strays are divided, so that fewer triangles follow the field better.
TEST(FieldSimplification, FewerTrianglesFollowTheFieldBetterThanContouring) {
  const Volume volume = vessel();
  const TrilinearField field(volume);
  const EmissionMap emission = EmissionMap::window(20.0, 220.0);
  const BuiltShells plain = build(volume, emission, uniform_levels(4), 0.0);
  const BuiltShells simple = build(volume, emission, uniform_levels(4), 0.01);
  EXPECT_LT(simple.report.triangles, plain.report.triangles);
  for (std::size_t k = 0; k < 4; ++k) {
    const LevelError error(field, emission, plain.set.shells[k].emission);
    const testing::PointError off_border = error_off_border(field, error);
    EXPECT_LT(mean_square(simple.set.shells[k].surface, off_border),
              mean_square(plain.set.shells[k].surface, off_border));
  }
}

TEST(FieldSimplification, KeepsTheVolumeInside) {
  const BuiltShells plain =
      build(vessel(), EmissionMap::window(20.0, 220.0), uniform_levels(4), 0.0);
  const BuiltShells simple =
      build(vessel(), EmissionMap::window(20.0, 220.0), uniform_levels(4), 0.06);
  for (std::size_t k = 0; k < 4; ++k) {
    const double before = check_shell(plain.set.shells[k].surface).volume_mm3;
    const double after = check_shell(simple.set.shells[k].surface).volume_mm3;
    EXPECT_NEAR(after, before, 0.04 * before);
  }
}

TEST(FieldSimplification, AConstantVolumeIsItsBox) {
  const Volume volume = testing::volume_of<std::uint8_t>({6, 5, 4}, [](auto...) { return 7; });
  const BuiltShells built = build(volume, EmissionMap::window(0.0, 7.0), uniform_levels(3), 0.02);
  expect_sound(built.set);
  for (const Shell& shell : built.set.shells) {
    EXPECT_NEAR(check_shell(shell.surface).volume_mm3, 60.0, 0.5);
    EXPECT_LE(shell.surface.triangles.size(), 80u) << "flat sides cost little";
  }
}

TEST(FieldSimplification, AxesOfOneVoxelStaySound) {
  for (const glm::i64vec3 dims : {glm::i64vec3(1, 9, 8), glm::i64vec3(9, 8, 1),
                                  glm::i64vec3(1, 1, 12), glm::i64vec3(1, 1, 1)}) {
    const Volume volume = testing::random_volume<std::uint16_t>(dims, 0, 1000);
    expect_sound(build(volume, EmissionMap::window(0.0, 1000.0), uniform_levels(4), 0.03).set);
  }
}

TEST(FieldSimplification, ExtremeSpacingsStaySound) {
  Volume volume = testing::random_volume<float>({7, 7, 7}, 0, 1);
  for (const glm::dvec3 spacing :
       {glm::dvec3(1, 1, 1000), glm::dvec3(1000, 1, 1), glm::dvec3(1e-6), glm::dvec3(1e6)}) {
    volume.world_from_voxel = glm::scale(glm::dmat4(1.0), spacing);
    expect_sound(build(volume, EmissionMap::window(0, 1), uniform_levels(3), 0.05).set);
  }
}

TEST(FieldSimplification, ExtremeValuesStaySound) {
  const auto check = [](const Volume& volume, double lo, double hi) {
    expect_sound(build(volume, EmissionMap::window(lo, hi), uniform_levels(3), 0.05).set);
  };
  check(testing::random_volume<float>({6, 6, 6}, 1e-38, 2e-38), 1e-38, 2e-38);
  check(testing::random_volume<float>({6, 6, 6}, -1e38, 1e38), -1e38, 1e38);
  check(testing::random_volume<std::int16_t>({6, 6, 6}, -32768, 32767), -32768, 32767);
}

TEST(FieldSimplification, LevelsAlmostAtOnePlaceStaySound) {
  std::vector<double> emissions;
  for (int i = 0; i < 5; ++i) emissions.push_back(0.4 + 1e-6 * i);
  const BuiltShells built =
      build(vessel(), EmissionMap::window(20.0, 220.0), explicit_levels(emissions), 0.02);
  expect_sound(built.set);
}

TEST(FieldSimplification, AVoxelAboveTheLevelIsNotLost) {
  Volume volume = testing::volume_of<std::uint8_t>(
      {7, 7, 7}, [](auto i, auto j, auto k) { return i == 3 && j == 3 && k == 3 ? 200 : 0; });
  const BuiltShells built = build(volume, EmissionMap::window(0, 200), uniform_levels(4), 0.05);
  expect_sound(built.set);
  for (const Shell& shell : built.set.shells) EXPECT_GE(shell.surface.triangles.size(), 4u);
}

TEST(FieldSimplification, IsTheSameForAnyNumberOfThreads) {
  const EmissionMap emission = EmissionMap::window(20.0, 220.0);
  for (const ToleranceWeight weight : {ToleranceWeight::Field, ToleranceWeight::Picture}) {
    const ShellSet many = build(vessel(), emission, uniform_levels(5), 0.03, weight).set;
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const ShellSet single = build(vessel(), emission, uniform_levels(5), 0.03, weight).set;
    for (std::size_t k = 0; k < many.shells.size(); ++k) {
      EXPECT_EQ(many.shells[k].surface.positions, single.shells[k].surface.positions);
      EXPECT_EQ(many.shells[k].surface.triangles, single.shells[k].surface.triangles);
    }
  }
}

}  // namespace
}  // namespace nacre

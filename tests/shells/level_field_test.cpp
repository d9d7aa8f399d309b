#include "shells/level_field.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

Volume noise() {
  Volume volume = testing::random_volume<float>({7, 6, 5}, 0.0, 100.0);
  volume.world_from_voxel = glm::scale(
      glm::rotate(glm::dmat4(1.0), 0.4, glm::dvec3(1.0, 2.0, -1.0)), glm::dvec3(0.5, 0.7, 1.3));
  return volume;
}

/// A point of the box, in voxels, at least `margin` from its border.
glm::dvec3 inner_point(std::mt19937& random, double margin) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const glm::dvec3 span = glm::dvec3(6, 5, 4) - 2.0 * margin;
  return margin + span * glm::dvec3(unit(random), unit(random), unit(random));
}

glm::dvec3 local_of(const Volume& volume, const glm::dvec3& p_voxel) {
  return glm::dmat3(volume.world_from_voxel) * (p_voxel - glm::dvec3(3.0, 2.5, 2.0));
}

TEST(LevelField, IsTheDistanceFromTheLevelWhereTheMapRises) {
  const Volume volume = noise();
  const TrilinearField field(volume);
  const EmissionMap emission = EmissionMap::window(-10.0, 110.0);
  const LevelField level(field, emission, 0.4);
  const LevelError error(field, emission, 0.4);
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 p = local_of(volume, inner_point(random, 0.01));
    EXPECT_NEAR(std::abs(level(p).error), error(p), 1e-12);
  }
}

TEST(LevelField, IsNeverLessThanTheErrorAndOfItsSign) {
  const Volume volume = noise();
  const TrilinearField field(volume);
  const EmissionMap emission =
      EmissionMap::piecewise_linear({{30.0, 0.0}, {40.0, 0.2}, {60.0, 1.0}});
  std::mt19937 random(4);
  for (const double t : {0.1, 0.2, 0.7, 1.0}) {
    const LevelField level(field, emission, t);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 p_voxel = inner_point(random, 0.01);
      const double phi = emission(field.value(p_voxel));
      const double signed_error = level(local_of(volume, p_voxel)).error;
      EXPECT_GE(std::abs(signed_error), std::abs(phi - t) - 1e-12);
      EXPECT_GE(signed_error * (phi - t), -1e-12);
    }
  }
}

// Central differences, within a cell and a piece of the map.
TEST(LevelField, GradientIsTheErrorsDerivative) {
  const Volume volume = noise();
  const TrilinearField field(volume);
  const EmissionMap emission = EmissionMap::window(20.0, 80.0);
  const LevelField level(field, emission, 0.5);
  constexpr double kStep = 1e-5;
  std::mt19937 random(5);
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 p_voxel = inner_point(random, 0.01);
    const glm::dvec3 in_cell = glm::fract(p_voxel);
    const double value = field.value(p_voxel);
    if (std::min({in_cell.x, in_cell.y, in_cell.z}) < 1e-3) continue;
    if (std::max({in_cell.x, in_cell.y, in_cell.z}) > 1.0 - 1e-3) continue;
    if (std::min(std::abs(value - 20.0), std::abs(value - 80.0)) < 0.1) continue;
    const glm::dvec3 p = local_of(volume, p_voxel);
    const glm::dvec3 gradient = level(p).gradient;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 d(0.0);
      d[axis] = kStep;
      const double slope = (level(p + d).error - level(p - d).error) / (2.0 * kStep);
      EXPECT_NEAR(gradient[axis], slope, 1e-4 * (1.0 + std::abs(slope)));
    }
    ++compared;
  }
  EXPECT_GT(compared, 200);
}

TEST(LevelField, BordersPinWhatIsInsideAndLetTheRestSlideAlongThem) {
  const Volume volume = testing::volume_of<float>(
      {5, 5, 5}, [](auto i, auto j, auto) { return 20.0 * double(i) + 2.0 * double(j); });
  const TrilinearField field(volume);
  const EmissionMap emission = EmissionMap::window(0.0, 100.0);
  const LevelField level(field, emission, 0.5);
  const FieldSample inside = level({1.0, 0.0, 2.0});
  EXPECT_EQ(inside.error, 0.0);
  EXPECT_EQ(inside.gradient, glm::dvec3(0.0));
  const FieldSample outside_the_set = level({-1.0, 0.0, 2.0});
  EXPECT_LT(outside_the_set.error, 0.0);
  EXPECT_GT(outside_the_set.gradient.x, 0.0);
  EXPECT_EQ(outside_the_set.gradient.z, 0.0);
  EXPECT_EQ(level({0.0, 0.0, 2.5}).error, 1.0) << "beyond the border";
}

}  // namespace
}  // namespace nacre

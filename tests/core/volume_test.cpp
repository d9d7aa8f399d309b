#include "core/volume.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "core/error.h"
#include "core/volume_geometry.h"

namespace nacre {
namespace {

TEST(Volume, HoldsTheBytesOfItsShapeAndType) {
  const Volume volume = make_volume({3, 4, 5}, ScalarType::I16);
  EXPECT_EQ(volume.samples.size(), 3u * 4 * 5 * 2);
  EXPECT_EQ(sample_count(volume), 60u);
  EXPECT_EQ(samples_as<std::int16_t>(volume).size(), 60u);
}

TEST(Volume, VisitsTheSamplesAsTheirOwnType) {
  for (const ScalarType type :
       {ScalarType::U8, ScalarType::I8, ScalarType::U16, ScalarType::I16, ScalarType::U32,
        ScalarType::I32, ScalarType::F32, ScalarType::F64}) {
    const Volume volume = make_volume({2, 1, 1}, type);
    const auto visited = visit_samples(volume, []<class T>(std::span<const T> samples) {
      EXPECT_EQ(samples.size(), 2u);
      return scalar_type_of<T>();
    });
    EXPECT_EQ(visited, type);
  }
}

TEST(Volume, RefusesAnEmptyAxisAndAnOverflow) {
  EXPECT_THROW(make_volume({0, 4, 5}, ScalarType::U8), Error);
  EXPECT_THROW(make_volume({4, -1, 5}, ScalarType::U8), Error);
  const std::int64_t huge = std::numeric_limits<std::int64_t>::max();
  EXPECT_THROW(make_volume({huge, huge, 2}, ScalarType::F64), Error);
}

TEST(VolumeGeometry, ASingleSampleSpansOneSpacing) {
  const VoxelBox box = voxel_box({1, 5, 2});
  EXPECT_EQ(box.lo, glm::dvec3(-0.5, 0, 0));
  EXPECT_EQ(box.hi, glm::dvec3(0.5, 4, 1));
}

TEST(VolumeGeometry, SphereIsAroundTheBoxFromFirstToLastSample) {
  glm::dmat4 world_from_voxel(1.0);
  world_from_voxel[0] = {-2, 0, 0, 0};
  world_from_voxel[3] = {10, 20, 30, 1};
  const BoundingSphere sphere = bounding_sphere({4, 3, 2}, world_from_voxel);
  EXPECT_EQ(sphere.center_mm, glm::dvec3(7, 21, 30.5));
  EXPECT_DOUBLE_EQ(sphere.radius_mm, 0.5 * std::sqrt(36.0 + 4 + 1));
}

TEST(VolumeGeometry, TellsShearSpacingAndHandedness) {
  glm::dmat4 world_from_voxel(1.0);
  world_from_voxel[1] = {0.0, 3.0, 0.0, 0.0};
  world_from_voxel[2] = {0.0, std::sin(0.1), std::cos(0.1), 0.0};
  EXPECT_NEAR(shear_rad(world_from_voxel), 0.1, 1e-12);
  EXPECT_NEAR(spacing_mm(world_from_voxel).y, 3.0, 1e-12);
  EXPECT_NEAR(handedness(world_from_voxel), std::cos(0.1), 1e-12);
  world_from_voxel[0] = -world_from_voxel[0];
  EXPECT_LT(handedness(world_from_voxel), 0.0);
  world_from_voxel[0] = world_from_voxel[1];
  EXPECT_NEAR(handedness(world_from_voxel), 0.0, 1e-12);
}

}  // namespace
}  // namespace nacre

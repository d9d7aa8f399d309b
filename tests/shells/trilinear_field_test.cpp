#include "shells/trilinear_field.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

#include "core/error.h"
#include "shells/voxel_checksum.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::random_volume;
using testing::volume_of;

double linear(double x, double y, double z) { return 3.0 + 2.0 * x - y + 0.5 * z + x * y * z; }

Volume linear_volume(const glm::i64vec3& dims) {
  return volume_of<float>(dims, [](std::int64_t x, std::int64_t y, std::int64_t z) {
    return linear(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
  });
}

/// The value is x, from 0 to 10.
Volume ramp() {
  return volume_of<float>({11, 3, 3}, [](std::int64_t x, auto, auto) { return x; });
}

TEST(TrilinearField, InterpolatesInTheShellsFrame) {
  Volume volume = linear_volume({5, 4, 6});
  volume.slope = 2.0;
  volume.intercept = -1.0;
  volume.world_from_voxel = glm::translate(
      glm::rotate(glm::scale(glm::dmat4(1.0), {0.5, 1.0, 2.0}), 0.7, {1.0, 2.0, 3.0}),
      {1e6, -1e6, 10.0});
  const TrilinearField field(volume);
  const glm::dvec3 center(2.0, 1.5, 2.5);
  for (const glm::dvec3 p : {glm::dvec3(0.0), glm::dvec3(4, 3, 5), glm::dvec3(1.25, 2.5, 3.75)}) {
    const glm::dvec3 local(glm::dmat3(volume.world_from_voxel) * (p - center));
    const glm::dvec3 back = field.voxel_from_local(local);
    EXPECT_NEAR(glm::length(back - p), 0.0, 1e-12);
    EXPECT_NEAR(field.value(p), 2.0 * linear(p.x, p.y, p.z) - 1.0, 1e-5);
  }
}

TEST(TrilinearField, IsConstantBeyondTheBox) {
  const Volume volume = linear_volume({3, 3, 1});
  const TrilinearField field(volume);
  EXPECT_DOUBLE_EQ(field.value({-5.0, 1.0, 0.0}), linear(0, 1, 0));
  EXPECT_DOUBLE_EQ(field.value({9.0, 9.0, 0.4}), linear(2, 2, 0));
}

TEST(TrilinearField, RefusesASingularMatrix) {
  Volume volume = linear_volume({2, 2, 2});
  volume.world_from_voxel[1] = volume.world_from_voxel[0];
  EXPECT_THROW(TrilinearField{volume}, Error);
}

TEST(LevelError, IsTheDistanceFromTheLevelInEmission) {
  const Volume volume = ramp();
  const TrilinearField field(volume);
  const EmissionMap emission = EmissionMap::window(0.0, 10.0);
  const LevelError error(field, emission, 0.5);
  EXPECT_NEAR(error({0.0, 0.0, 0.0}), 0.0, 1e-12);
  EXPECT_NEAR(error({2.0, 0.0, 0.0}), 0.2, 1e-12);
  EXPECT_NEAR(error({-3.0, 0.0, 0.0}), 0.3, 1e-12);
}

// A cap lies in the border plane, where the set is cut off: no error there, but outside the set.
TEST(LevelError, IsZeroOnACap) {
  const Volume volume = ramp();
  const TrilinearField field(volume);
  const EmissionMap emission = EmissionMap::window(0.0, 10.0);
  const LevelError error(field, emission, 0.5);
  EXPECT_EQ(error({5.0, 0.3, 0.1}), 0.0);
  EXPECT_EQ(error({2.0, 1.0, 0.0}), 0.0);
  EXPECT_NEAR(error({-2.0, 1.0, 0.0}), 0.2, 1e-12);
}

TEST(VoxelChecksum, TellsSamplesApart) {
  Volume volume = random_volume<std::int16_t>({200, 100, 90}, -1000, 1000);  // several blocks
  const std::uint64_t before = voxel_checksum(volume);
  EXPECT_EQ(voxel_checksum(volume), before);
  samples_as<std::int16_t>(volume).back() ^= 1;
  EXPECT_NE(voxel_checksum(volume), before);
}

}  // namespace
}  // namespace nacre

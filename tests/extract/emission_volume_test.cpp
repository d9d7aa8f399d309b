#include "extract/emission_volume.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::volume_of;

Volume ramp() {
  return volume_of<std::uint8_t>({11, 1, 1}, [](auto x, auto, auto) { return 10 * x; });
}

double emission_at(const EmissionVolume& mapped, std::size_t i) {
  return visit_samples(mapped.volume, [&](auto samples) {
    return mapped.emission(mapped.volume.slope * static_cast<double>(samples[i]) +
                           mapped.volume.intercept);
  });
}

TEST(MapVolume, ARisingMapLeavesTheVolumeAlone) {
  const EmissionVolume mapped = map_volume(ramp(), {{20, 0}, {50, 0.5}, {80, 1}});
  EXPECT_EQ(mapped.volume.type, ScalarType::U8);
  EXPECT_DOUBLE_EQ(emission_at(mapped, 3), 1.0 / 6);
  EXPECT_DOUBLE_EQ(emission_at(mapped, 9), 1.0);
}

TEST(MapVolume, AFallingMapNegatesTheValues) {
  const EmissionVolume mapped = map_volume(ramp(), {{20, 1}, {80, 0}});
  EXPECT_EQ(mapped.volume.type, ScalarType::U8);
  EXPECT_EQ(mapped.volume.slope, -1.0);
  EXPECT_DOUBLE_EQ(emission_at(mapped, 0), 1.0);
  EXPECT_DOUBLE_EQ(emission_at(mapped, 5), 0.5);
  EXPECT_DOUBLE_EQ(emission_at(mapped, 10), 0.0);
}

TEST(MapVolume, AMapThatRisesAndFallsIsAppliedAtTheVoxels) {
  const EmissionVolume mapped = map_volume(ramp(), {{0, 0}, {50, 1}, {100, 0.2}});
  EXPECT_EQ(mapped.volume.type, ScalarType::F32);
  EXPECT_FLOAT_EQ(static_cast<float>(emission_at(mapped, 4)), 0.8f);
  EXPECT_FLOAT_EQ(static_cast<float>(emission_at(mapped, 5)), 1.0f);
  EXPECT_FLOAT_EQ(static_cast<float>(emission_at(mapped, 10)), 0.2f);
}

TEST(MapVolume, RefusesBadKnots) {
  EXPECT_THROW(map_volume(ramp(), {{20, 0}}), Error);
  EXPECT_THROW(map_volume(ramp(), {{20, 0}, {10, 1}}), Error);
  EXPECT_THROW(map_volume(ramp(), {{20, 0}, {30, 1.5}, {40, 0}}), Error);
  EXPECT_THROW(map_volume(ramp(), {{20, 0.5}, {30, 0.5}}), Error);
}

}  // namespace
}  // namespace nacre

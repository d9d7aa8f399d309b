#include <gtest/gtest.h>

#include <vector>

#include "core/emission.h"
#include "extract/default_window.h"
#include "extract/levels.h"
#include "extract/marching_cubes.h"
#include "io/volume_reader.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/test_data.h"

namespace nacre {
namespace {

/// All shells of a real scan are sound.
void expect_sound(const std::filesystem::path& path, std::size_t level_count) {
  const Volume volume = read_volume(path).volume;
  const Window window = default_window(volume);
  const EmissionMap emission = EmissionMap::window(window.lo, window.hi);
  std::vector<double> values;
  for (const Level& level : uniform_levels(level_count)) {
    values.push_back(emission.value_at(level.emission));
  }
  for (const TriangleMesh& mesh : extract_surfaces(volume, values)) {
    const testing::MeshFacts facts = testing::facts_of(mesh);
    EXPECT_EQ(testing::flaw_of(facts), "") << path;
    EXPECT_GT(facts.volume, 0.0) << path;
  }
}

TEST(ScannedSurfaces, OfAFloatAngiogram) {
  NACRE_TEST_DATA_OR_SKIP(path, "volumes/avf_float_32.nii.gz");
  expect_sound(path, 4);
}

TEST(ScannedSurfaces, OfABrainWithAScaledWindow) {
  NACRE_TEST_DATA_OR_SKIP(path, "volumes/MR_Gd.nii.gz");
  expect_sound(path, 1);
}

TEST(ScannedSurfaces, OfAnAngiogramWithoutBackground) {
  NACRE_TEST_DATA_OR_SKIP(path, "volumes/chris_MRA.nii.gz");
  expect_sound(path, 2);
}

}  // namespace
}  // namespace nacre

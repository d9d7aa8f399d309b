// Sampled maxima of real scans, against the exact ones.
#include <gtest/gtest.h>

#include <vector>

#include "casting/sampled_maximum.h"
#include "core/volume_geometry.h"
#include "io/volume_reader.h"
#include "reference/exact_picture.h"
#include "report/picture_error.h"
#include "tests/support/test_data.h"

namespace nacre {
namespace {

#ifdef NDEBUG
constexpr int kSide = 256;
constexpr double kGain = 5.0;  // dB, for twice as many
#else
constexpr int kSide = 64;  // of which single pixels count for more
constexpr double kGain = 2.0;
#endif

/// PSNR over lit pixels, of 1, 2, ... samples a voxel.
std::vector<double> lit_psnr(const std::filesystem::path& file, const EmissionMap& map,
                             std::initializer_list<int> samples) {
  const Volume volume = read_volume(file).volume;
  const ExactWalk walk(volume, map);
  const SampledMaximum maximum(walk);
  const Camera camera =
      make_camera({.size = {kSide, kSide}, .azimuth_rad = 0.5, .elevation_rad = 0.2},
                  bounding_sphere(volume.dims, volume.world_from_voxel));
  const Image exact = exact_picture(walk, camera).volume;
  std::vector<double> result;
  for (const int per_cell : samples) {
    const Image image = maximum.picture(camera, {.per_cell = per_cell}).volume;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      EXPECT_LE(image.pixels[i], exact.pixels[i] + 1e-4F);
    }
    const PictureError lit = compare_pictures(image, exact, 1.0).lit;
    EXPECT_GT(lit.pixels, 100U);
    result.push_back(lit.psnr_db);
  }
  return result;
}

void expect_rising(const std::vector<double>& psnr, double first) {
  EXPECT_GT(psnr[0], first);
  for (std::size_t i = 1; i < psnr.size(); ++i) EXPECT_GT(psnr[i], psnr[i - 1] + kGain);
}

TEST(SampledScans, AngiogramsAreCloseWithFewSamples) {
  NACRE_TEST_DATA_OR_SKIP(head, "volumes/chris_MRA.nii.gz");
  expect_rising(lit_psnr(head, EmissionMap::window(20.0, 230.0), {1, 2, 4, 8}), 34.0);
  NACRE_TEST_DATA_OR_SKIP(rotational, "volumes/aneurism_256_uint8.nrrd");
  expect_rising(lit_psnr(rotational, EmissionMap::window(20.0, 250.0), {1, 2, 4, 8}), 32.0);
}

TEST(SampledScans, ThickSlicesAndMirroredAxesToo) {
  NACRE_TEST_DATA_OR_SKIP(brain, "volumes/brain1_image.nrrd");
  expect_rising(lit_psnr(brain, EmissionMap::window(500.0, 2500.0), {1, 2, 4, 8}), 25.0);
  NACRE_TEST_DATA_OR_SKIP(aorta, "volumes/aorta.mha");
  expect_rising(lit_psnr(aorta, EmissionMap::window(500.0, 2200.0), {1, 2, 4, 8}), 30.0);
}

}  // namespace
}  // namespace nacre

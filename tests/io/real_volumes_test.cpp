#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <string>
#include <vector>

#include "core/volume_geometry.h"
#include "io/volume_reader.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test_data.h"

namespace nacre {
namespace {

/// One row of the data's README: what was read from the file by independent means.
struct Row {
  const char* file;
  glm::i64vec3 dims;
  ScalarType type;
  glm::dvec3 spacing_mm;
  double spacing_tolerance;  ///< half a unit of the last digit the README shows
  double lowest;             ///< stored
  double highest;
  double range_tolerance = 0.0;
};

struct Range {
  double lowest;
  double highest;
};

Range stored_range(const Volume& volume) {
  return visit_samples(volume, [](auto samples) {
    const auto [lowest, highest] = std::minmax_element(samples.begin(), samples.end());
    return Range{static_cast<double>(*lowest), static_cast<double>(*highest)};
  });
}

class RealVolume : public ::testing::TestWithParam<Row> {};

TEST_P(RealVolume, HasTheDimsTypeSpacingAndRangeOfItsReadme) {
  const Row& row = GetParam();
  NACRE_TEST_DATA_OR_SKIP(path, std::string("volumes/") + row.file);
  const VolumeFile file = read_volume(path);
  EXPECT_EQ(file.volume.dims, row.dims);
  EXPECT_EQ(file.volume.type, row.type);
  const glm::dvec3 spacing = spacing_mm(file.volume.world_from_voxel);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(spacing[axis], row.spacing_mm[axis], row.spacing_tolerance) << "axis " << axis;
  }
  const Range range = stored_range(file.volume);
  EXPECT_NEAR(range.lowest, row.lowest, row.range_tolerance);
  EXPECT_NEAR(range.highest, row.highest, row.range_tolerance);
}

constexpr double kFourDigits = 0.00005;

INSTANTIATE_TEST_SUITE_P(
    Readme, RealVolume,
    ::testing::Values(
        Row{"chris_MRA.nii.gz",
            {200, 256, 120},
            ScalarType::U8,
            {0.5208, 0.5208, 0.65},
            kFourDigits,
            0,
            254},
        Row{"MR_Gd.nii.gz",
            {176, 188, 144},
            ScalarType::U8,
            {0.9766, 0.9766, 1.0026},
            kFourDigits,
            0,
            255},
        Row{"aneurism_256_uint8.nrrd", {256, 256, 256}, ScalarType::U8, {1, 1, 1}, 0.0, 0, 255},
        Row{"aorta.mha",
            {157, 393, 34},
            ScalarType::F32,
            {0.8789, 0.8789, 1.5001},
            kFourDigits,
            0,
            2570.2,
            0.05},
        Row{"avf_float_32.nrrd",
            {74, 93, 20},
            ScalarType::F32,
            {0.7227, 0.7227, 1},
            kFourDigits,
            0,
            2509.89,
            0.005},
        Row{"avf_float_32.nii.gz",
            {74, 93, 20},
            ScalarType::F32,
            {0.7227, 0.7227, 1},
            kFourDigits,
            0,
            2509.89,
            0.005},
        Row{"carotid_76x49x45_float32.mhd",
            {76, 49, 45},
            ScalarType::F32,
            {1, 1, 1},
            0.0,
            0,
            580,
            0.5},
        Row{"hipip_neg_64_uint8.mhd", {64, 64, 64}, ScalarType::U8, {1, 1, 1}, 0.0, 0, 255},
        Row{"hipip_pos_64_uint8.mhd", {64, 64, 64}, ScalarType::U8, {1, 1, 1}, 0.0, 0, 255},
        Row{"hipip_signed_64_int16.mhd", {64, 64, 64}, ScalarType::I16, {1, 1, 1}, 0.0, -255, 255},
        Row{"headsq_64x64x93_int16.nhdr",
            {64, 64, 93},
            ScalarType::I16,
            {3.2, 3.2, 1.5},
            0.0,
            0,
            3926},
        Row{"brain1_image.nrrd",
            {256, 256, 25},
            ScalarType::I16,
            {0.7812, 0.7812, 6.5},
            kFourDigits,
            0,
            3057},
        Row{"tooth.nhdr", {103, 94, 161}, ScalarType::U16, {1, 1, 1}, 0.0, 0, 1300},
        Row{"HeadMRVolume.mhd", {48, 62, 42}, ScalarType::U8, {4, 4, 4}, 0.0, 0, 255}),
    [](const auto& test) {
      std::string name = test.param.file;
      std::replace_if(
          name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
      return name;
    });

TEST(RealVolumes, TheSameScanInTwoFormatsIsTheSameVolume) {
  NACRE_TEST_DATA_OR_SKIP(nrrd_path, "volumes/avf_float_32.nrrd");
  NACRE_TEST_DATA_OR_SKIP(nifti_path, "volumes/avf_float_32.nii.gz");
  const Volume nrrd = read_volume(nrrd_path).volume;
  const Volume nifti = read_volume(nifti_path).volume;
  ASSERT_EQ(nrrd.samples.size(), nifti.samples.size());
  EXPECT_EQ(std::memcmp(nrrd.samples.data(), nifti.samples.data(), nrrd.samples.size()), 0);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      // NIfTI-1 stores the frame in float.
      EXPECT_NEAR(nrrd.world_from_voxel[column][row], nifti.world_from_voxel[column][row], 2e-5)
          << "column " << column << ", row " << row;
    }
  }
}

TEST(RealVolumes, KeepNegativeDirections) {
  NACRE_TEST_DATA_OR_SKIP(path, "volumes/avf_float_32.nrrd");
  const glm::dmat4 matrix = read_volume(path).volume.world_from_voxel;
  EXPECT_NEAR(matrix[0][0], -0.7227, kFourDigits);
  EXPECT_NEAR(matrix[1][1], -0.7227, kFourDigits);
  EXPECT_NEAR(matrix[2][2], 1.0, kFourDigits);
  EXPECT_NEAR(matrix[3][0], 26.377, 0.0005);
  EXPECT_NEAR(matrix[3][1], 33.242, 0.0005);
  EXPECT_NEAR(matrix[3][2], -9.5, 0.0005);
}

TEST(RealVolumes, SpaceADicomSeriesByItsPositions) {
  NACRE_TEST_DATA_OR_SKIP(path, "volumes/dicom_brain_pd");
  const VolumeFile file = read_volume(path);
  EXPECT_EQ(file.volume.dims, glm::i64vec3(256, 256, 19));
  EXPECT_EQ(file.volume.type, ScalarType::I16);
  const glm::dvec3 spacing = spacing_mm(file.volume.world_from_voxel);
  EXPECT_NEAR(spacing.x, 0.8594, kFourDigits);
  EXPECT_NEAR(spacing.y, 0.8594, kFourDigits);
  EXPECT_NEAR(spacing.z, 7.0, 0.005);  // SpacingBetweenSlices says 2, SliceThickness 5
  const glm::dmat4& matrix = file.volume.world_from_voxel;
  EXPECT_NEAR(matrix[1][1] / spacing.y, 0.99096, 1e-5);
  EXPECT_NEAR(matrix[1][2] / spacing.y, 0.134158, 1e-5);
  EXPECT_GT(handedness(matrix), 0.0);
  EXPECT_EQ(stored_range(file.volume).highest, 1059);
  EXPECT_EQ(stored_range(file.volume).lowest, 0);
}

/// The corners of a binary STL's triangles.
std::vector<glm::dvec3> stl_corners(const std::filesystem::path& path) {
  constexpr std::size_t header = 84;
  constexpr std::size_t triangle = 50;
  const std::string bytes = testing::read_bytes(path);
  std::vector<glm::dvec3> corners;
  for (std::size_t begin = header; begin + triangle <= bytes.size(); begin += triangle) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::array<float, 3> p{};
      std::memcpy(p.data(), bytes.data() + begin + 12 * (corner + 1), sizeof(p));
      corners.emplace_back(p[0], p[1], p[2]);
    }
  }
  return corners;
}

TEST(RealVolumes, HoldTheSurfaceThatWasSegmentedFromThem) {
  NACRE_TEST_DATA_OR_SKIP(volume_path, "volumes/aorta.mha");
  NACRE_TEST_DATA_OR_SKIP(surface_path, "volumes/aorta-surface.stl");
  const Volume volume = read_volume(volume_path).volume;
  const glm::dmat4 voxel_from_world = glm::inverse(volume.world_from_voxel);
  const VoxelBox box = voxel_box(volume.dims);
  const std::vector<glm::dvec3> corners = stl_corners(surface_path);
  ASSERT_EQ(corners.size(), 3u * 12932);
  for (const glm::dvec3& p_ras : corners) {
    const glm::dvec3 p_voxel(voxel_from_world * glm::dvec4(-p_ras.x, -p_ras.y, p_ras.z, 1.0));
    ASSERT_TRUE(glm::all(glm::greaterThanEqual(p_voxel, box.lo)) &&
                glm::all(glm::lessThanEqual(p_voxel, box.hi)));
  }
}

TEST(RealVolumes, KeepTheScaleOfAScaledNifti) {
  NACRE_TEST_DATA_OR_SKIP(path, "volumes/MR_Gd.nii.gz");
  const Volume volume = read_volume(path).volume;
  EXPECT_NEAR(volume.slope, 6.48235, 0.000005);
  EXPECT_EQ(volume.intercept, 0.0);
}

TEST(RealVolumes, KeepAFlippedTransformMatrix) {
  NACRE_TEST_DATA_OR_SKIP(path, "volumes/aorta.mha");
  const glm::dmat4 matrix = read_volume(path).volume.world_from_voxel;
  EXPECT_NEAR(matrix[0][0], -0.8789, kFourDigits);
  EXPECT_NEAR(matrix[1][1], -0.8789, kFourDigits);
  EXPECT_NEAR(matrix[2][2], 1.5001, kFourDigits);
  EXPECT_NEAR(matrix[3][0], -156.445, 0.0005);
  EXPECT_NEAR(matrix[3][1], -24.609, 0.0005);
}

}  // namespace
}  // namespace nacre

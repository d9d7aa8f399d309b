#include "io/volume_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/non_finite.h"
#include "io/volume_checks.h"
#include "tests/support/expect_error.h"
#include "tests/support/scratch_folder.h"

namespace nacre {
namespace {

using testing::bytes_of;
using testing::expect_error;
using testing::ScratchFolder;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Volume line_of(const std::vector<float>& values) {
  Volume volume = make_volume({static_cast<std::int64_t>(values.size()), 1, 1}, ScalarType::F32);
  std::copy(values.begin(), values.end(), samples_as<float>(volume).begin());
  return volume;
}

std::vector<float> values_of(const Volume& volume) {
  const auto samples = samples_as<float>(volume);
  return {samples.begin(), samples.end()};
}

TEST(NonFinite, NanBecomesTheLowestAndInfinitiesTheExtremes) {
  Volume volume = line_of({1, kNan, -5, kInfinity, -kInfinity, 9, kNan});
  VolumeReadReport report;
  replace_non_finite("v", volume, report);
  EXPECT_EQ(values_of(volume), (std::vector<float>{1, -5, -5, 9, -5, 9, -5}));
  EXPECT_EQ(report.nan_count, 2u);
  EXPECT_EQ(report.positive_infinity_count, 1u);
  EXPECT_EQ(report.negative_infinity_count, 1u);
}

TEST(NonFinite, NanBecomesTheLowestValueUnderANegativeSlope) {
  Volume volume = line_of({1, kNan, 9});
  volume.slope = -1;
  VolumeReadReport report;
  replace_non_finite("v", volume, report);
  EXPECT_EQ(values_of(volume), (std::vector<float>{1, 9, 9}));
}

TEST(NonFinite, AVolumeWithoutAFiniteSampleIsRefused) {
  Volume volume = line_of({kNan, kInfinity});
  VolumeReadReport report;
  expect_error(ErrorCode::BadFile, "no finite sample",
               [&] { replace_non_finite("v", volume, report); });
}

TEST(NonFinite, ValuesThatOverflowAreRefused) {
  Volume volume = make_volume({2, 1, 1}, ScalarType::F64);
  samples_as<double>(volume)[0] = -1.5e308;
  samples_as<double>(volume)[1] = 1.5e308;
  VolumeReadReport report;
  expect_error(ErrorCode::BadFile, "range of a double",
               [&] { replace_non_finite("v", volume, report); });
  samples_as<double>(volume)[0] = 0;
  EXPECT_NO_THROW(replace_non_finite("v", volume, report));
  volume.slope = 10;
  expect_error(ErrorCode::BadFile, "slope 10", [&] { replace_non_finite("v", volume, report); });
}

TEST(RawHeader, ParsesDimensionsTypeAndSpacing) {
  const RawHeader plain = parse_raw_header("4,3,2,u8");
  EXPECT_EQ(plain.dims, glm::i64vec3(4, 3, 2));
  EXPECT_EQ(plain.type, ScalarType::U8);
  EXPECT_FALSE(plain.big_endian);
  EXPECT_EQ(plain.spacing_mm, glm::dvec3(1));
  const RawHeader full = parse_raw_header("4,3,2,f32be,0.5,1,2.5e0");
  EXPECT_EQ(full.type, ScalarType::F32);
  EXPECT_TRUE(full.big_endian);
  EXPECT_EQ(full.spacing_mm, glm::dvec3(0.5, 1, 2.5));
}

TEST(RawHeader, RefusesAnythingElse) {
  for (const char* text : {"", "4,3,2", "4,3,2,u7", "4,3,0,u8", "4,3,-2,u8", "4,3,2,u8,1,1",
                           "4,3,2,u8,1,1,0", "4,3,2,u8,1,1,nan", "4,3,2,u8,1,1,1,1", "4x,3,2,u8",
                           "99999999999999999999,1,1,u8", "4,3,2,be", "4, 3,2,u8"}) {
    expect_error(ErrorCode::BadArgument, std::string("found \"") + text + "\"",
                 [&] { parse_raw_header(text); });
  }
}

class VolumeReader : public ::testing::Test {
 protected:
  VolumeFile read_raw(const std::string& header, const std::string& bytes,
                      const char* crop = nullptr) {
    VolumeReadOptions options{.raw = parse_raw_header(header)};
    if (crop != nullptr) options.crop = parse_voxel_crop(crop);
    return read_volume(folder_.write("a.bin", bytes), options);
  }
  ScratchFolder folder_;
};

TEST_F(VolumeReader, ReadsRawSamplesInEitherByteOrder) {
  for (const bool big_endian : {false, true}) {
    const VolumeFile file = read_raw(big_endian ? "2,1,1,i16be,2,3,4" : "2,1,1,i16,2,3,4",
                                     bytes_of<std::int16_t>({-2, 258}, big_endian));
    EXPECT_EQ(samples_as<std::int16_t>(file.volume)[0], -2);
    EXPECT_EQ(samples_as<std::int16_t>(file.volume)[1], 258);
    EXPECT_EQ(file.volume.world_from_voxel[2][2], 4);
    EXPECT_EQ(file.report.format, "raw");
  }
}

TEST_F(VolumeReader, RefusesARawFileOfAnotherSize) {
  for (const std::size_t size : {23, 25}) {
    expect_error(ErrorCode::BadFile, "expected 4 x 3 x 2 samples of 1 bytes, 24 in all",
                 [&] { read_raw("4,3,2,u8", std::string(size, 'a')); });
  }
  expect_error(ErrorCode::BadFile, "found 1 bytes",
               [&] { read_raw("4000000000,4000000000,4000000000,f64", "a"); });
}

TEST_F(VolumeReader, CropsWithBothEndsIncludedAndKeepsEachVoxelInItsPlace) {
  std::string bytes;
  for (int i = 0; i < 24; ++i) bytes += static_cast<char>(i);
  const Volume part = read_raw("4,3,2,u8,2,3,5", bytes, "1,2,0,1,1,1").volume;
  EXPECT_EQ(part.dims, glm::i64vec3(2, 2, 1));
  const auto samples = samples_as<std::uint8_t>(part);
  EXPECT_EQ((std::vector<std::uint8_t>(samples.begin(), samples.end())),
            (std::vector<std::uint8_t>{13, 14, 17, 18}));
  EXPECT_EQ(glm::dvec3(part.world_from_voxel[3]), glm::dvec3(2, 0, 5));
}

TEST_F(VolumeReader, TheCropOfTheWholeIsTheWhole) {
  const Volume whole = read_raw("4,3,2,u8", std::string(24, 'x'), "0,3,0,2,0,1").volume;
  EXPECT_EQ(whole.dims, glm::i64vec3(4, 3, 2));
}

TEST_F(VolumeReader, RefusesACropOutsideTheVolume) {
  expect_error(ErrorCode::BadArgument, "a crop from 0 to 4 along x, expected voxels from 0 to 3",
               [&] { read_raw("4,3,2,u8", std::string(24, 'x'), "0,4,0,2,0,1"); });
  for (const char* text : {"", "0,1,0,1,0", "0,1,0,1,0,1,0", "1,0,0,1,0,1", "-1,0,0,1,0,1", "a"}) {
    expect_error(ErrorCode::BadArgument, "expected X0,X1,Y0,Y1,Z0,Z1",
                 [&] { parse_voxel_crop(text); });
  }
}

TEST_F(VolumeReader, ReplacesNonFiniteSamplesOfTheWholeBeforeACrop) {
  const VolumeFile file = read_raw("3,1,1,f32", bytes_of<float>({-7, kNan, 2}), "1,2,0,0,0,0");
  EXPECT_EQ(values_of(file.volume), (std::vector<float>{-7, 2}));
  EXPECT_EQ(file.report.nan_count, 1u);
}

TEST_F(VolumeReader, NamesWhatIsNoVolume) {
  expect_error(ErrorCode::BadFile, "found no such file",
               [&] { read_volume(folder_.path() / "absent.nrrd"); });
  expect_error(ErrorCode::BadFile, "extension \".xyz\"",
               [&] { read_volume(folder_.write("a.xyz", "abc")); });
  expect_error(ErrorCode::BadFile, "the folder that holds its series",
               [&] { read_volume(folder_.write("a.dcm", "abc")); });
  expect_error(ErrorCode::BadFile, "the folder that holds its series",
               [&] { read_volume(folder_.write("a", std::string(128, '\0') + "DICM")); });
}

TEST(VolumeGeometryCheck, KeepsASmallShearSilentAndRefusesFlatCells) {
  VolumeReadReport report;
  glm::dmat4 matrix(1.0);
  matrix[1][0] = 0.001;  // 0.06 degree
  check_geometry("v", matrix, report);
  EXPECT_TRUE(report.warnings.empty());
  matrix[1][0] = 0.002;  // 0.11 degree
  check_geometry("v", matrix, report);
  EXPECT_EQ(report.warnings.size(), 1u);
  matrix[1][0] = 50;  // determinant 0.02
  EXPECT_NO_THROW(check_geometry("v", matrix, report));
  matrix[1][0] = 200;
  expect_error(ErrorCode::BadFile, "singular", [&] { check_geometry("v", matrix, report); });
}

}  // namespace
}  // namespace nacre

#include <gtest/gtest.h>

#include <cmath>

#include "core/volume_geometry.h"
#include "io/volume_reader.h"
#include "tests/support/dicom_files.h"
#include "tests/support/expect_error.h"
#include "tests/support/scratch_folder.h"

namespace nacre {
namespace {

using testing::DicomSliceSpec;
using testing::expect_error;
using testing::read_bytes;
using testing::ScratchFolder;
using testing::write_dicom;

/// Positions are written with nine digits.
constexpr double kDigits = 1e-6;

class DicomSeries : public ::testing::Test {
 protected:
  /// `count` slices, `step` apart, filled with 10, 11, 12 ...; named against their order.
  static std::vector<DicomSliceSpec> slices_along(const glm::dvec3& step, int count) {
    std::vector<DicomSliceSpec> slices(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      DicomSliceSpec& slice = slices[static_cast<std::size_t>(i)];
      slice.position = glm::dvec3(-10, 20, 30) + static_cast<double>(i) * step;
      slice.fill = static_cast<std::int16_t>(10 + i);
    }
    return slices;
  }
  void write(const std::vector<DicomSliceSpec>& slices) {
    for (const DicomSliceSpec& slice : slices) {
      write_dicom(slice, folder_.path() / ("s" + std::to_string(900 - written_++) + ".dcm"));
    }
  }
  VolumeFile read(const std::string& series = "") {
    return read_volume(folder_.path(), {.dicom_series = series});
  }
  void expect_refused(const std::vector<DicomSliceSpec>& slices, const std::string& part) {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      std::filesystem::remove(entry.path());
    }
    write(slices);
    expect_error(ErrorCode::BadFile, part, [&] { read(); });
  }

  ScratchFolder folder_;
  int written_ = 0;
};

std::int16_t first_of_slice(const Volume& volume, std::int64_t z) {
  return samples_as<std::int16_t>(
      volume)[static_cast<std::size_t>(z * volume.dims.x * volume.dims.y)];
}

TEST_F(DicomSeries, IsOrderedAndSpacedByPositions) {
  write(slices_along({0, 0, 7}, 4));
  const VolumeFile file = read();
  EXPECT_EQ(file.volume.dims, glm::i64vec3(6, 4, 4));
  EXPECT_EQ(file.volume.type, ScalarType::I16);
  EXPECT_EQ(file.report.format, "DICOM series");
  for (int z = 0; z < 4; ++z) EXPECT_EQ(first_of_slice(file.volume, z), 10 + z);
  const glm::dmat4 expected(glm::dvec4(0.75, 0, 0, 0), glm::dvec4(0, 0.5, 0, 0),
                            glm::dvec4(0, 0, 7, 0), glm::dvec4(-10, 20, 30, 1));
  EXPECT_EQ(file.volume.world_from_voxel, expected);
}

TEST_F(DicomSeries, RunsAlongTheNormalWhateverTheNames) {
  write(slices_along({0, 0, -7}, 4));
  const Volume volume = read().volume;
  EXPECT_EQ(first_of_slice(volume, 0), 13);
  EXPECT_EQ(volume.world_from_voxel[2][2], 7);
  EXPECT_EQ(volume.world_from_voxel[3][2], 30 - 21);
}

TEST_F(DicomSeries, KeepsATiltedGantryAsAShear) {
  const double tilt = 15 * M_PI / 180;
  const glm::dvec3 step(0, 5 * std::sin(tilt), 5 * std::cos(tilt));
  write(slices_along(step, 5));
  const VolumeFile file = read();
  for (int row = 0; row < 3; ++row) {
    EXPECT_NEAR(file.volume.world_from_voxel[2][row], step[row], kDigits);
  }
  ASSERT_EQ(file.report.warnings.size(), 1u);
  EXPECT_NE(file.report.warnings[0].find("sheared by 15 degrees"), std::string::npos);
}

TEST_F(DicomSeries, PassesOverOtherFiles) {
  write(slices_along({0, 0, 7}, 3));
  folder_.write("README.txt", "not an image");
  folder_.write("empty", "");
  std::filesystem::create_directory(folder_.path() / "folder");
  const VolumeFile file = read();
  EXPECT_EQ(file.volume.dims.z, 3);
  ASSERT_EQ(file.report.warnings.size(), 1u);
  EXPECT_NE(file.report.warnings[0].find("2 files without a DICOM image"), std::string::npos);
}

TEST_F(DicomSeries, AsksWhichOfSeveralSeries) {
  write(slices_along({0, 0, 7}, 3));
  std::vector<DicomSliceSpec> other = slices_along({0, 0, 2}, 2);
  for (DicomSliceSpec& slice : other) slice.series_uid = "1.2.3.5";
  write(other);
  expect_error(ErrorCode::BadArgument,
               "found 2 series: 1.2.3.4 (3 slices of 6 x 4), 1.2.3.5 (2 slices of 6 x 4), expected "
               "--series",
               [&] { read(); });
  expect_error(ErrorCode::BadArgument, "2 series", [&] { read("9.9"); });
  EXPECT_EQ(read("1.2.3.5").volume.dims.z, 2);
  EXPECT_EQ(read("1.2.3.4").volume.dims.z, 3);
}

TEST_F(DicomSeries, KeepsSlopeAndInterceptThatAllSlicesShare) {
  std::vector<DicomSliceSpec> slices = slices_along({0, 0, 7}, 3);
  for (DicomSliceSpec& slice : slices) {
    slice.slope = "2.5";
    slice.intercept = "-1024";
  }
  write(slices);
  const Volume volume = read().volume;
  EXPECT_EQ(volume.type, ScalarType::I16);
  EXPECT_EQ(volume.slope, 2.5);
  EXPECT_EQ(volume.intercept, -1024);
  EXPECT_EQ(first_of_slice(volume, 0), 10);
}

TEST_F(DicomSeries, StoresValuesWhereSlicesScaleDifferently) {
  std::vector<DicomSliceSpec> slices = slices_along({0, 0, 7}, 3);
  for (std::size_t i = 0; i < 3; ++i) slices[i].slope = std::to_string(i + 1);
  write(slices);
  const Volume volume = read().volume;
  ASSERT_EQ(volume.type, ScalarType::F32);
  EXPECT_EQ(volume.slope, 1);
  const auto samples = samples_as<float>(volume);
  for (std::size_t z = 0; z < 3; ++z) {
    EXPECT_EQ(samples[24 * z], static_cast<float>((z + 1) * (10 + z)));
  }
}

TEST_F(DicomSeries, FillsTheBitsAboveThoseStored) {
  std::vector<DicomSliceSpec> slices = slices_along({0, 0, 7}, 2);
  for (DicomSliceSpec& slice : slices) {
    slice.bits_stored = 12;
    slice.samples = {0x0fff, 0x07ff, 0x0800};  // -1, 2047, -2048 in 12 bits
  }
  write(slices);
  const Volume volume = read().volume;
  EXPECT_EQ(samples_as<std::int16_t>(volume)[0], -1);
  EXPECT_EQ(samples_as<std::int16_t>(volume)[1], 2047);
  EXPECT_EQ(samples_as<std::int16_t>(volume)[2], -2048);
}

TEST_F(DicomSeries, DecodesCompressedSlices) {
  std::vector<DicomSliceSpec> slices = slices_along({0, 0, 7}, 3);
  for (DicomSliceSpec& slice : slices) {
    slice.is_signed = false;
    slice.jpeg_lossless = true;
    slice.samples = {0, 1000, 7, 32000};
  }
  write(slices);
  const Volume volume = read().volume;
  ASSERT_EQ(volume.type, ScalarType::U16);
  EXPECT_EQ(samples_as<std::uint16_t>(volume)[1], 1000);
  EXPECT_EQ(samples_as<std::uint16_t>(volume)[3], 32000);
}

TEST_F(DicomSeries, ReadsMonochrome1WithAWarning) {
  std::vector<DicomSliceSpec> slices = slices_along({0, 0, 7}, 2);
  for (DicomSliceSpec& slice : slices) slice.photometric = "MONOCHROME1";
  write(slices);
  const VolumeFile file = read();
  EXPECT_EQ(first_of_slice(file.volume, 1), 11);
  ASSERT_EQ(file.report.warnings.size(), 1u);
  EXPECT_NE(file.report.warnings[0].find("MONOCHROME1"), std::string::npos);
}

TEST_F(DicomSeries, WarnsOfUnevenSlices) {
  std::vector<DicomSliceSpec> slices = slices_along({0, 0, 7}, 5);
  slices[2].position.z += 0.2;
  write(slices);
  const VolumeFile file = read();
  ASSERT_EQ(file.report.warnings.size(), 1u);
  EXPECT_NE(file.report.warnings[0].find("up to 2.9 %"), std::string::npos);
}

TEST_F(DicomSeries, RefusesSlicesThatMakeNoGrid) {
  std::vector<DicomSliceSpec> slices = slices_along({0, 0, 7}, 6);
  slices.erase(slices.begin() + 2);
  expect_refused(slices, "found 14 mm between slices 2 and 3, expected 7 mm");

  slices = slices_along({0, 0, 7}, 3);
  const auto again = slices_along({0, 0, 7}, 3);
  slices.insert(slices.end(), again.begin(), again.end());
  expect_refused(slices, "6 slices at 3 positions");

  slices = slices_along({0, 0, 7}, 3);
  slices[1].columns = 8;
  expect_refused(slices, "6 x 4 and of 8 x 4 samples");

  slices = slices_along({0, 0, 7}, 3);
  slices[1].y_direction = {0, 0, 1};
  expect_refused(slices, "more than one orientation");

  slices = slices_along({0, 0, 7}, 3);
  slices[1].has_position = false;
  expect_refused(slices, "ImagePositionPatient");

  slices = slices_along({0, 0, 7}, 3);
  for (DicomSliceSpec& slice : slices) slice.pixel_spacing = "0.5\\0";
  expect_refused(slices, "a pixel spacing of 0 x 0.5 mm");
}

TEST_F(DicomSeries, RefusesColourAndMultiFrameImages) {
  std::vector<DicomSliceSpec> slices = slices_along({0, 0, 7}, 2);
  for (DicomSliceSpec& slice : slices) slice.photometric = "RGB";
  expect_refused(slices, "colour samples (RGB)");
  slices = slices_along({0, 0, 7}, 1);
  slices[0].frames = 3;
  slices[0].is_signed = false;
  expect_refused(slices, "multi-frame");
}

TEST_F(DicomSeries, RefusesTruncatedSlicesAndEmptyFolders) {
  expect_error(ErrorCode::BadFile, "a folder without DICOM images", [&] { read(); });
  write(slices_along({0, 0, 7}, 3));
  const auto path = folder_.path() / "s899.dcm";
  const std::string whole = read_bytes(path);
  folder_.write("s899.dcm", whole.substr(0, whole.size() - 10));
  expect_error(ErrorCode::BadFile, "s899.dcm", [&] { read(); });
  DicomSliceSpec compressed = slices_along({0, 0, 7}, 2)[1];
  compressed.is_signed = false;
  compressed.jpeg_lossless = true;
  write_dicom(compressed, path);
  const std::string packed = read_bytes(path);
  folder_.write("s899.dcm", packed.substr(0, packed.size() - 10));
  expect_error(ErrorCode::BadFile, "s899.dcm", [&] { read(); });
  folder_.write("s899.dcm", whole.substr(0, 200));
  expect_error(ErrorCode::BadFile, "s899.dcm", [&] { read(); });
}

TEST_F(DicomSeries, AsksForTheFolderOfASingleFile) {
  write(slices_along({0, 0, 7}, 1));
  expect_error(ErrorCode::BadFile, "the folder that holds its series",
               [&] { read_volume(folder_.path() / "s900.dcm"); });
}

}  // namespace
}  // namespace nacre

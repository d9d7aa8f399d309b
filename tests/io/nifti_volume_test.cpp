#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/volume_geometry.h"
#include "io/volume_reader.h"
#include "tests/support/expect_error.h"
#include "tests/support/scratch_folder.h"

namespace nacre {
namespace {

using testing::ByteBlock;
using testing::bytes_of;
using testing::deflated;
using testing::expect_error;
using testing::ScratchFolder;

using Row = std::array<float, 4>;

constexpr double kFloatRounding = 1e-6;

/// A NIfTI-1 file spelled out by the byte offsets of its specification, not by any library.
struct Nifti1 {
  bool big_endian = false;
  std::vector<std::int16_t> dim{3, 4, 3, 2};
  std::array<float, 4> pixdim{1, 2, 3, 4};
  std::int16_t datatype = 2;
  std::int16_t bitpix = 8;
  float offset = 352;
  float slope = 0;
  float intercept = 0;
  char units = 2;
  std::int16_t qform_code = 0;
  std::int16_t sform_code = 1;
  std::array<float, 6> quatern{};  // b, c, d, then the offset
  std::array<Row, 3> srow{Row{2, 0, 0, 10}, Row{0, 3, 0, 20}, Row{0, 0, 4, 30}};
  std::string magic{"n+1\0", 4};
  std::string samples = std::string(24, '\7');

  std::string header() const {
    ByteBlock block(352, big_endian);
    block.put<std::int32_t>(0, 348);
    for (std::size_t i = 0; i < dim.size(); ++i) block.put(40 + 2 * i, dim[i]);
    block.put(70, datatype);
    block.put(72, bitpix);
    for (std::size_t i = 0; i < pixdim.size(); ++i) block.put(76 + 4 * i, pixdim[i]);
    block.put(108, offset);
    block.put(112, slope);
    block.put(116, intercept);
    block.put(123, units);
    block.put(252, qform_code);
    block.put(254, sform_code);
    for (std::size_t i = 0; i < 6; ++i) block.put(256 + 4 * i, quatern[i]);
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t i = 0; i < 4; ++i) block.put(280 + 16 * row + 4 * i, srow[row][i]);
    }
    block.put_text(344, magic);
    return block.bytes();
  }
  std::string bytes() const { return header() + samples; }
};

class NiftiVolume : public ::testing::Test {
 protected:
  VolumeFile read(const Nifti1& nifti) const {
    return read_volume(folder_.write("a.nii", nifti.bytes()));
  }
  void expect_refused(const Nifti1& nifti, const std::string& part) const {
    expect_error(ErrorCode::BadFile, part, [&] { read(nifti); });
  }
  ScratchFolder folder_;
};

TEST_F(NiftiVolume, TurnsItsRasSformIntoLps) {
  const Volume volume = read({}).volume;
  EXPECT_EQ(volume.dims, glm::i64vec3(4, 3, 2));
  EXPECT_EQ(volume.type, ScalarType::U8);
  const glm::dmat4 expected(glm::dvec4(-2, 0, 0, 0), glm::dvec4(0, -3, 0, 0),
                            glm::dvec4(0, 0, 4, 0), glm::dvec4(-10, -20, 30, 1));
  EXPECT_EQ(volume.world_from_voxel, expected);
}

TEST_F(NiftiVolume, TakesTheQformWithoutAnSform) {
  Nifti1 nifti;
  nifti.sform_code = 0;
  nifti.qform_code = 1;
  // A quarter turn about z: x of the voxels along A, y along L (R negative).
  const float half = std::sqrt(0.5f);
  nifti.quatern = {0, 0, half, 10, 20, 30};
  const glm::dmat4 matrix = read(nifti).volume.world_from_voxel;
  EXPECT_NEAR(matrix[0][1], -2, kFloatRounding);
  EXPECT_NEAR(matrix[1][0], 3, kFloatRounding);
  EXPECT_NEAR(matrix[2][2], 4, kFloatRounding);
  EXPECT_EQ(glm::dvec3(matrix[3]), glm::dvec3(-10, -20, 30));
}

TEST_F(NiftiVolume, MirrorsTheThirdAxisOfAQformWithNegativeQfac) {
  Nifti1 nifti;
  nifti.sform_code = 0;
  nifti.qform_code = 1;
  nifti.pixdim[0] = -1;
  const glm::dmat4 matrix = read(nifti).volume.world_from_voxel;
  EXPECT_EQ(matrix[2][2], -4);
  EXPECT_LT(handedness(matrix), 0);
}

TEST_F(NiftiVolume, AssumesRasWithoutAnyFormAndSaysSo) {
  Nifti1 nifti;
  nifti.sform_code = 0;
  const VolumeFile file = read(nifti);
  EXPECT_EQ(glm::dvec3(file.volume.world_from_voxel[0]), glm::dvec3(-2, 0, 0));
  EXPECT_EQ(glm::dvec3(file.volume.world_from_voxel[1]), glm::dvec3(0, -3, 0));
  ASSERT_EQ(file.report.warnings.size(), 1u);
  EXPECT_NE(file.report.warnings[0].find("no orientation"), std::string::npos);
}

TEST_F(NiftiVolume, WarnsWhereSformAndQformDisagreeByMoreThanAVoxel) {
  Nifti1 nifti;
  nifti.qform_code = 1;
  nifti.quatern = {0, 0, 0, 10, 20, 30};
  EXPECT_TRUE(read(nifti).report.warnings.empty());
  nifti.quatern[3] = 12.5f;
  const VolumeFile file = read(nifti);
  ASSERT_EQ(file.report.warnings.size(), 1u);
  EXPECT_NE(file.report.warnings[0].find("2.5 mm"), std::string::npos);
  EXPECT_EQ(file.volume.world_from_voxel[3][0], -10);
}

TEST_F(NiftiVolume, ConvertsMetresAndMicronsToMillimetres) {
  Nifti1 nifti;
  nifti.units = 1;
  EXPECT_NEAR(spacing_mm(read(nifti).volume.world_from_voxel).x, 2000, kFloatRounding);
  nifti.units = 3;
  EXPECT_NEAR(spacing_mm(read(nifti).volume.world_from_voxel).x, 0.002, kFloatRounding);
  nifti.units = 0;
  EXPECT_EQ(spacing_mm(read(nifti).volume.world_from_voxel).x, 2);
}

TEST_F(NiftiVolume, HonoursItsSlopeUnlessItIsZero) {
  Nifti1 nifti;
  nifti.slope = 0.5f;
  nifti.intercept = -3;
  EXPECT_EQ(read(nifti).volume.slope, 0.5);
  EXPECT_EQ(read(nifti).volume.intercept, -3);
  nifti.slope = 0;
  EXPECT_EQ(read(nifti).volume.slope, 1);
  EXPECT_EQ(read(nifti).volume.intercept, 0);
}

TEST_F(NiftiVolume, SwapsBigEndianSamples) {
  Nifti1 nifti{.big_endian = true, .dim = {3, 2, 1, 1}, .datatype = 4, .bitpix = 16};
  nifti.samples = bytes_of<std::int16_t>({-2, 258}, true);
  const Volume volume = read(nifti).volume;
  ASSERT_EQ(volume.type, ScalarType::I16);
  EXPECT_EQ(samples_as<std::int16_t>(volume)[0], -2);
  EXPECT_EQ(samples_as<std::int16_t>(volume)[1], 258);
  EXPECT_EQ(volume.world_from_voxel[3][2], 30);
}

TEST_F(NiftiVolume, ReadsAFileThatIsGzippedWhateverItsName) {
  const std::string packed = deflated(Nifti1{}.bytes());
  EXPECT_EQ(read_volume(folder_.write("a.nii.gz", packed)).volume.dims, glm::i64vec3(4, 3, 2));
  EXPECT_EQ(read_volume(folder_.write("b.nii", packed)).volume.dims, glm::i64vec3(4, 3, 2));
}

TEST_F(NiftiVolume, ReadsAHeaderWithItsImageBesideIt) {
  Nifti1 nifti;
  nifti.magic = std::string("ni1\0", 4);
  nifti.offset = 0;
  nifti.samples[1] = 9;
  folder_.write("a.hdr", nifti.header().substr(0, 348));
  folder_.write("a.img", nifti.samples);
  for (const char* name : {"a.hdr", "a.img"}) {
    const Volume volume = read_volume(folder_.path() / name).volume;
    EXPECT_EQ(samples_as<std::uint8_t>(volume)[1], 9) << name;
  }
}

TEST_F(NiftiVolume, IsThreeDimensionalIfFurtherDimensionsAreOne) {
  Nifti1 nifti;
  nifti.dim = {5, 4, 3, 2, 1, 1};
  EXPECT_EQ(read(nifti).volume.dims, glm::i64vec3(4, 3, 2));
}

TEST_F(NiftiVolume, IsOneSliceIfTwoDimensional) {
  Nifti1 nifti;
  nifti.dim = {2, 8, 3};
  nifti.sform_code = 0;
  nifti.qform_code = 1;
  nifti.pixdim[3] = 0;
  EXPECT_EQ(read(nifti).volume.dims, glm::i64vec3(8, 3, 1));
  EXPECT_EQ(spacing_mm(read(nifti).volume.world_from_voxel).z, 1);
}

TEST_F(NiftiVolume, KeepsAShearAndWarns) {
  Nifti1 nifti;
  nifti.srow[1][2] = 1;
  const VolumeFile file = read(nifti);
  EXPECT_EQ(glm::dvec3(file.volume.world_from_voxel[2]), glm::dvec3(0, -1, 4));
  ASSERT_EQ(file.report.warnings.size(), 1u);
  EXPECT_NE(file.report.warnings[0].find("sheared"), std::string::npos);
}

TEST_F(NiftiVolume, KeepsSixtyFourBitIntegersThatFitThirtyTwo) {
  Nifti1 nifti{.dim = {3, 2, 1, 1}, .datatype = 1024, .bitpix = 64};
  nifti.samples = bytes_of<std::int64_t>({-5, 7});
  VolumeFile file = read(nifti);
  ASSERT_EQ(file.volume.type, ScalarType::I32);
  EXPECT_EQ(samples_as<std::int32_t>(file.volume)[0], -5);
  EXPECT_EQ(file.report.warnings.size(), 1u);
  nifti.samples = bytes_of<std::int64_t>({4'000'000'000, 7});
  ASSERT_EQ(read(nifti).volume.type, ScalarType::U32);
  nifti.samples = bytes_of<std::int64_t>({-5, 4'000'000'000});
  expect_refused(nifti, "64-bit integers from -5 to 4000000000");
}

TEST_F(NiftiVolume, RefusesWhatItCannotShow) {
  expect_refused({.dim = {4, 4, 3, 2, 7}}, "4 dimensions (4 x 3 x 2 x 7)");
  expect_refused({.datatype = 128, .bitpix = 24}, "colour samples (NIFTI_TYPE_RGB24)");
  expect_refused({.datatype = 32, .bitpix = 64}, "complex samples");
  expect_refused({.datatype = 1, .bitpix = 1}, "BINARY");
  expect_refused({.datatype = 1536, .bitpix = 128}, "FLOAT128");
  expect_refused({.datatype = 77}, "code 77");
}

TEST_F(NiftiVolume, RefusesDamagedHeaders) {
  expect_refused({.dim = {9, 4, 3, 2}}, "9 dimensions");
  expect_refused({.dim = {3, 4, -3, 2}}, "-3 samples");
  expect_refused({.dim = {3, 4, 0, 2}}, "0 samples");
  expect_refused({.pixdim = {1, 2, 0, 4}, .sform_code = 0}, "a spacing of 0 along axis 1");
  expect_refused({.pixdim = {1, 2, -3, 4}, .sform_code = 0}, "a spacing of -3");
  expect_refused({.pixdim = {1, 2, NAN, 4}, .sform_code = 0}, "a spacing of nan");
  expect_refused({.offset = -1}, "samples at byte -1");
  expect_refused({.offset = 1e30f}, "samples at byte");
  expect_refused({.slope = INFINITY}, "slope inf");
  expect_refused({.magic = "abcd"}, "ANALYZE");
  expect_error(ErrorCode::BadFile, "an empty file",
               [&] { read_volume(folder_.write("e.nii", "")); });
  expect_error(ErrorCode::BadFile, "no NIfTI header",
               [&] { read_volume(folder_.write("e.nii", std::string(400, 'x'))); });
}

TEST_F(NiftiVolume, RefusesSingularFrames) {
  Nifti1 nifti;
  nifti.srow[2] = nifti.srow[1];
  expect_refused(nifti, "spacing of 0 mm along axis 2");
  nifti.srow[2] = {2, 3, 0, 0};
  nifti.srow[0] = {2, 3, 0, 0};
  nifti.srow[1] = {0, 0, 4, 0};
  expect_refused(nifti, "singular directions");
  nifti.srow[0][0] = std::numeric_limits<float>::quiet_NaN();
  expect_refused(nifti, "not finite");
}

TEST_F(NiftiVolume, RefusesTruncatedSamples) {
  Nifti1 nifti;
  nifti.samples.pop_back();
  expect_refused(nifti, "found 23 bytes for samples, expected 24");
  nifti.samples += '\7';
  std::string packed = deflated(nifti.bytes());
  packed.resize(packed.size() - 12);
  expect_error(ErrorCode::BadFile, "bytes of samples, expected 24",
               [&] { read_volume(folder_.write("a.nii.gz", packed)); });
}

TEST_F(NiftiVolume, RefusesAClaimBeyondItsSizeBeforeAllocating) {
  // 32767^3 doubles would be 281 TB.
  const Nifti1 nifti{.dim = {3, 32767, 32767, 32767}, .datatype = 64, .bitpix = 64};
  expect_refused(nifti, "as the header says");
  expect_error(ErrorCode::BadFile, "compressed bytes for samples",
               [&] { read_volume(folder_.write("a.nii.gz", deflated(nifti.bytes()))); });
}

TEST_F(NiftiVolume, ReadsVersion2) {
  ByteBlock block(544, false);
  block.put<std::int32_t>(0, 540);
  block.put_text(4, std::string_view("n+2\0\r\n\032\n", 8));
  block.put<std::int16_t>(12, 512);
  block.put<std::int16_t>(14, 16);
  const std::array<std::int64_t, 8> dim{3, 40000, 1, 1, 1, 1, 1, 1};
  for (std::size_t i = 0; i < 8; ++i) block.put(16 + 8 * i, dim[i]);
  block.put<std::int64_t>(168, 544);
  block.put<double>(176, 0.1);
  block.put<std::int32_t>(348, 2);
  block.put<double>(400, 0.7);
  block.put<double>(400 + 24, -1.1);
  block.put<double>(432 + 8, 0.8);
  block.put<double>(464 + 16, 0.9);
  block.put<std::int32_t>(500, 2);
  block.append(std::span<const std::uint16_t>(std::vector<std::uint16_t>(40000, 513)));
  const VolumeFile file = read_volume(folder_.write("b.nii", block.bytes()));
  EXPECT_EQ(file.report.format, "NIfTI-2");
  EXPECT_EQ(file.volume.dims, glm::i64vec3(40000, 1, 1));
  EXPECT_EQ(file.volume.slope, 0.1);
  EXPECT_EQ(file.volume.world_from_voxel[0][0], -0.7);
  EXPECT_EQ(file.volume.world_from_voxel[3][0], 1.1);
  EXPECT_EQ(samples_as<std::uint16_t>(file.volume)[39999], 513);
}

}  // namespace
}  // namespace nacre

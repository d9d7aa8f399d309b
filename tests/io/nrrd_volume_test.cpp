#include <gtest/gtest.h>

#include "core/volume_geometry.h"
#include "io/volume_reader.h"
#include "tests/support/expect_error.h"
#include "tests/support/scratch_folder.h"

namespace nacre {
namespace {

using testing::bytes_of;
using testing::deflated;
using testing::expect_error;
using testing::ScratchFolder;

const std::string kSizes = "type: uchar\ndimension: 3\nsizes: 4 3 2\n";
const std::string kDirections =
    "space directions: (2,0,0) (0,3,0) (0,0,4)\nspace origin: (10,20,30)\n";
const std::string kRaw = "encoding: raw\n";

class NrrdVolume : public ::testing::Test {
 protected:
  /// An attached file: magic, fields, an empty line, samples.
  VolumeFile read(const std::string& fields, const std::string& samples = std::string(24, 7)) {
    return read_volume(folder_.write("a.nrrd", "NRRD0004\n" + fields + "\n" + samples));
  }
  void expect_refused(const std::string& fields, const std::string& part) {
    expect_error(ErrorCode::BadFile, part, [&] { read(fields); });
  }
  ScratchFolder folder_;
};

TEST_F(NrrdVolume, KeepsLps) {
  const Volume volume =
      read(kSizes + "space: left-posterior-superior\n" + kDirections + kRaw).volume;
  EXPECT_EQ(volume.dims, glm::i64vec3(4, 3, 2));
  EXPECT_EQ(volume.type, ScalarType::U8);
  const glm::dmat4 expected(glm::dvec4(2, 0, 0, 0), glm::dvec4(0, 3, 0, 0), glm::dvec4(0, 0, 4, 0),
                            glm::dvec4(10, 20, 30, 1));
  EXPECT_EQ(volume.world_from_voxel, expected);
}

TEST_F(NrrdVolume, TurnsRasIntoLps) {
  const glm::dmat4 matrix = read(kSizes + "space: right-anterior-superior\n" + kDirections + kRaw)
                                .volume.world_from_voxel;
  EXPECT_EQ(matrix[0][0], -2);
  EXPECT_EQ(matrix[1][1], -3);
  EXPECT_EQ(matrix[2][2], 4);
  EXPECT_EQ(glm::dvec3(matrix[3]), glm::dvec3(-10, -20, 30));
}

TEST_F(NrrdVolume, TurnsLasIntoLps) {
  const glm::dmat4 matrix =
      read(kSizes + "space: LAS\n" + kDirections + kRaw).volume.world_from_voxel;
  EXPECT_EQ(matrix[0][0], 2);
  EXPECT_EQ(matrix[1][1], -3);
  EXPECT_EQ(matrix[2][2], 4);
  EXPECT_EQ(glm::dvec3(matrix[3]), glm::dvec3(10, -20, 30));
}

TEST_F(NrrdVolume, TakesASpaceWithoutNameAsLpsAndSaysSo) {
  const VolumeFile file = read(kSizes + "space dimension: 3\n" + kDirections + kRaw);
  EXPECT_EQ(file.volume.world_from_voxel[1][1], 3);
  EXPECT_EQ(file.report.warnings.size(), 1u);
}

TEST_F(NrrdVolume, WithoutDirectionsRunsAlongTheAxes) {
  const VolumeFile file = read(kSizes + "spacings: 0.5 0.25 2\n" + kRaw);
  EXPECT_EQ(spacing_mm(file.volume.world_from_voxel), glm::dvec3(0.5, 0.25, 2));
  EXPECT_EQ(file.volume.world_from_voxel[0][0], 0.5);
  EXPECT_EQ(file.report.warnings.size(), 1u);
}

TEST_F(NrrdVolume, ConvertsUnits) {
  const Volume metres =
      read(kSizes + "space: LPS\nspace units: \"m\" \"m\" \"m\"\n" + kDirections + kRaw).volume;
  EXPECT_EQ(metres.world_from_voxel[0][0], 2000);
  EXPECT_EQ(metres.world_from_voxel[3][2], 30000);
  const Volume microns =
      read(kSizes + "spacings: 1 1 1\nunits: \"um\" \"um\" \"um\"\n" + kRaw).volume;
  EXPECT_EQ(microns.world_from_voxel[2][2], 1e-3);
}

TEST_F(NrrdVolume, ReadsGzip) {
  std::string samples(24, 7);
  samples[23] = 42;
  const Volume volume = read(kSizes + "encoding: gzip\n", deflated(samples)).volume;
  EXPECT_EQ(samples_as<std::uint8_t>(volume)[23], 42);
}

TEST_F(NrrdVolume, ReadsGzipInSeveralMembers) {
  const std::string two = deflated(std::string(10, 1)) + deflated(std::string(14, 2));
  const Volume volume = read(kSizes + "encoding: gzip\n", two).volume;
  EXPECT_EQ(samples_as<std::uint8_t>(volume)[9], 1);
  EXPECT_EQ(samples_as<std::uint8_t>(volume)[10], 2);
}

TEST_F(NrrdVolume, SwapsBigEndianSamples) {
  const std::string fields =
      "type: ushort\ndimension: 3\nsizes: 2 1 1\nendian: big\nencoding: raw\n";
  const Volume volume = read(fields, bytes_of<std::uint16_t>({258, 65535}, true)).volume;
  EXPECT_EQ(samples_as<std::uint16_t>(volume)[0], 258);
  EXPECT_EQ(samples_as<std::uint16_t>(volume)[1], 65535);
}

TEST_F(NrrdVolume, SkipsLinesAndBytes) {
  std::string samples = "a line\nand another\nxyz" + std::string(24, 5);
  const Volume volume = read(kSizes + kRaw + "line skip: 2\nbyte skip: 3\n", samples).volume;
  EXPECT_EQ(samples_as<std::uint8_t>(volume)[0], 5);
  const Volume tail = read(kSizes + kRaw + "byte skip: -1\n", samples).volume;
  EXPECT_EQ(samples_as<std::uint8_t>(tail)[0], 5);
}

TEST_F(NrrdVolume, ReadsOneDataFileBesideItsHeader) {
  folder_.write("b data.raw", std::string(24, 3));
  const auto path =
      folder_.write("b.nhdr", "NRRD0004\n" + kSizes + kRaw + "data file: b data.raw\n");
  EXPECT_EQ(samples_as<std::uint8_t>(read_volume(path).volume)[0], 3);
}

TEST_F(NrrdVolume, ReadsOneDataFileASlice) {
  folder_.write("s_01.raw", std::string(12, 1));
  folder_.write("s_02.raw", std::string(12, 2));
  const std::string head = "NRRD0004\n" + kSizes + kRaw;
  for (const char* names :
       {"data file: s_%02d.raw 1 2 1\n", "data file: LIST\ns_01.raw\ns_02.raw\n"}) {
    const Volume volume = read_volume(folder_.write("c.nhdr", head + names)).volume;
    EXPECT_EQ(samples_as<std::uint8_t>(volume)[11], 1) << names;
    EXPECT_EQ(samples_as<std::uint8_t>(volume)[12], 2) << names;
  }
}

TEST_F(NrrdVolume, PassesOverAxesOfOneSample) {
  EXPECT_EQ(read("type: uchar\ndimension: 4\nsizes: 4 3 2 1\n" + kRaw).volume.dims,
            glm::i64vec3(4, 3, 2));
  EXPECT_EQ(
      read("type: uchar\ndimension: 4\nsizes: 1 4 3 2\nkinds: stub domain domain domain\n" + kRaw)
          .volume.dims,
      glm::i64vec3(4, 3, 2));
}

TEST_F(NrrdVolume, IsOneSliceIfTwoDimensional) {
  const Volume flat = read("type: uchar\ndimension: 2\nsizes: 8 3\n" + kRaw).volume;
  EXPECT_EQ(flat.dims, glm::i64vec3(8, 3, 1));
  const Volume placed = read(
                            "type: uchar\ndimension: 2\nsizes: 8 3\nspace: LPS\nspace directions: "
                            "(2,0,0) (0,0,2)\nspace origin: (0,5,0)\n" +
                            kRaw)
                            .volume;
  EXPECT_EQ(glm::dvec3(placed.world_from_voxel[2]), glm::dvec3(0, -1, 0));
}

TEST_F(NrrdVolume, RefusesWhatItCannotShow) {
  expect_refused("type: uchar\ndimension: 4\nsizes: 2 2 3 2\n" + kRaw,
                 "4 dimensions (2 x 2 x 3 x 2)");
  expect_refused("type: uchar\ndimension: 3\nsizes: 3 4 2\nkinds: RGB-color domain domain\n" + kRaw,
                 "RGB-color");
  expect_refused(
      "type: float\ndimension: 3\nsizes: 2 4 2\nkinds: complex domain domain\n"
      "endian: little\n" +
          kRaw,
      "complex");
  expect_refused("type: uchar\ndimension: 3\nsizes: 4 3 2\nkinds: domain domain time\n" + kRaw,
                 "time");
  expect_refused(
      "type: uchar\ndimension: 4\nsizes: 3 2 2 2\nspace: LPS\nspace directions: none "
      "(1,0,0) (0,1,0) (0,0,1)\n" +
          kRaw,
      "no direction");
  expect_refused("type: block\nblock size: 3\ndimension: 3\nsizes: 2 2 2\n" + kRaw, "block");
  expect_refused(kSizes + "encoding: ascii\n", "encoding ASCII");
  expect_refused(kSizes + "encoding: hex\n", "encoding hex");
}

TEST_F(NrrdVolume, RefusesFramesThatAreNone) {
  expect_refused(kSizes + "spacings: 1 0 1\n" + kRaw, "expected");
  expect_refused(kSizes + "spacings: 1 -2 1\n" + kRaw, "a spacing of -2 along axis 1");
  expect_refused(kSizes + "space: LPS\nspace directions: (1,0,0) (1,0,0) (0,0,1)\n" + kRaw,
                 "singular directions");
  expect_refused(kSizes + "space: LPS\nspace directions: (1,0,0) (0,0,0) (0,0,1)\n" + kRaw,
                 "a spacing of 0");
}

TEST_F(NrrdVolume, RefusesDamagedFiles) {
  expect_refused("type: uchar\ndimension: 3\n" + kRaw, "damaged header");
  expect_refused("type: uchar\ndimension: 3\nsizes: 4 x 2\n" + kRaw, "damaged header");
  expect_refused("type: ushort\ndimension: 3\nsizes: 2 2 2\n" + kRaw, "endian");
  expect_refused(kSizes + kRaw + "data file: %s%n%d 1 2 1\n", "PATTERN");
  expect_refused(kSizes + kRaw + "data file: absent.raw\n", "no such file");
  expect_error(ErrorCode::BadFile, "an empty file",
               [&] { read_volume(folder_.write("e.nrrd", "")); });
  expect_error(ErrorCode::BadFile, "found \"hello\"",
               [&] { read_volume(folder_.write("e.nrrd", "hello")); });
  expect_error(ErrorCode::BadFile, "cuts off",
               [&] { read_volume(folder_.write("e.nrrd", "NRRD0004\n" + kSizes + kRaw)); });
}

TEST_F(NrrdVolume, RefusesTruncatedSamples) {
  expect_error(ErrorCode::BadFile, "found 20 bytes for samples, expected 24",
               [&] { read(kSizes + kRaw, std::string(20, 7)); });
  std::string packed = deflated(std::string(24, 7));
  packed.resize(packed.size() - 4);
  expect_error(ErrorCode::BadFile, "without its end",
               [&] { read(kSizes + "encoding: gzip\n", packed); });
  packed.resize(packed.size() / 2);
  expect_error(ErrorCode::BadFile, "bytes of samples, expected 24",
               [&] { read(kSizes + "encoding: gzip\n", packed); });
}

TEST_F(NrrdVolume, NoticesADamagedStream) {
  std::string samples;
  for (int i = 0; i < 24; ++i) samples += static_cast<char>(i * 37);
  std::string packed = deflated(samples);
  packed[packed.size() - 6] ^= 1;  // in the checksum
  expect_error(ErrorCode::BadFile, "damaged compressed data",
               [&] { read(kSizes + "encoding: gzip\n", packed); });
}

TEST_F(NrrdVolume, RefusesAClaimBeyondItsSizeBeforeAllocating) {
  const std::string fields = "type: uchar\ndimension: 3\nsizes: 900000 900000 900000\n";
  expect_refused(fields + kRaw, "as the header says");
  expect_refused(fields + "encoding: gzip\n", "as the header says");
  expect_refused("type: uchar\ndimension: 3\nsizes: 4294967296 4294967296 4294967296\n" + kRaw,
                 "expected");
}

TEST_F(NrrdVolume, SaysThatBytesAreLeftOver) {
  const VolumeFile file = read(kSizes + "spacings: 1 1 1\n" + kRaw, std::string(25, 7));
  EXPECT_NE(file.report.warnings.back().find("more bytes"), std::string::npos);
}

}  // namespace
}  // namespace nacre

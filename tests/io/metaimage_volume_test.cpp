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

constexpr int kZlib = 15;
const std::string kHead = "ObjectType = Image\nNDims = 3\nBinaryData = True\n";
const std::string kSizes = "DimSize = 4 3 2\nElementType = MET_UCHAR\n";

class MetaImageVolume : public ::testing::Test {
 protected:
  VolumeFile read(const std::string& fields, const std::string& samples = std::string(24, 7)) {
    return read_volume(folder_.write("a.mha", fields + "ElementDataFile = LOCAL\n" + samples));
  }
  void expect_refused(const std::string& fields, const std::string& part) {
    expect_error(ErrorCode::BadFile, part, [&] { read(fields); });
  }
  ScratchFolder folder_;
};

TEST_F(MetaImageVolume, PlacesAxesByTheRowsOfItsTransformMatrix) {
  const Volume volume = read(kHead +
                             "TransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 10 20 30\n"
                             "ElementSpacing = 2 3 4\n" +
                             kSizes)
                            .volume;
  EXPECT_EQ(volume.dims, glm::i64vec3(4, 3, 2));
  const glm::dmat4 expected(glm::dvec4(0, 2, 0, 0), glm::dvec4(-3, 0, 0, 0), glm::dvec4(0, 0, 4, 0),
                            glm::dvec4(10, 20, 30, 1));
  EXPECT_EQ(volume.world_from_voxel, expected);
}

TEST_F(MetaImageVolume, WithoutGeometryIsTheIdentity) {
  EXPECT_EQ(read(kHead + kSizes).volume.world_from_voxel, glm::dmat4(1.0));
}

TEST_F(MetaImageVolume, TakesTheSizeOfElementsForTheirSpacing) {
  EXPECT_EQ(spacing_mm(read(kHead + "ElementSize = 2 3 4\n" + kSizes).volume.world_from_voxel),
            glm::dvec3(2, 3, 4));
}

TEST_F(MetaImageVolume, HonoursItsIntensityFunction) {
  const Volume volume = read(kHead +
                             "ElementToIntensityFunctionSlope = 0.25\n"
                             "ElementToIntensityFunctionOffset = -1000\n" +
                             kSizes)
                            .volume;
  EXPECT_EQ(volume.slope, 0.25);
  EXPECT_EQ(volume.intercept, -1000);
}

TEST_F(MetaImageVolume, ReadsCompressedSamples) {
  std::string samples(24, 7);
  samples[23] = 42;
  for (const int window_bits : {kZlib, 31}) {
    const Volume volume =
        read(kHead + "CompressedData = True\n" + kSizes, deflated(samples, window_bits)).volume;
    EXPECT_EQ(samples_as<std::uint8_t>(volume)[23], 42);
  }
}

TEST_F(MetaImageVolume, SwapsBigEndianSamples) {
  for (const char* key : {"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}) {
    const Volume volume = read(kHead + key + " = True\nDimSize = 2 1 1\nElementType = MET_SHORT\n",
                               bytes_of<std::int16_t>({-2, 258}, true))
                              .volume;
    EXPECT_EQ(samples_as<std::int16_t>(volume)[0], -2) << key;
    EXPECT_EQ(samples_as<std::int16_t>(volume)[1], 258) << key;
  }
}

TEST_F(MetaImageVolume, ReadsDataFilesBesideItsHeader) {
  folder_.write("b data.raw", "xyz" + std::string(24, 3));
  for (const char* skip : {"HeaderSize = 3\n", "HeaderSize = -1\n"}) {
    const auto path =
        folder_.write("b.mhd", kHead + skip + kSizes + "ElementDataFile = b data.raw\n");
    EXPECT_EQ(samples_as<std::uint8_t>(read_volume(path).volume)[0], 3) << skip;
  }
}

TEST_F(MetaImageVolume, ReadsOneDataFileASlice) {
  folder_.write("s_01.raw", std::string(12, 1));
  folder_.write("s_02.raw", std::string(12, 2));
  for (const char* names : {"s_%02d.raw 1 2 1\n", "LIST\ns_01.raw\ns_02.raw\n"}) {
    const auto path = folder_.write("c.mhd", kHead + kSizes + "ElementDataFile = " + names);
    const Volume volume = read_volume(path).volume;
    EXPECT_EQ(samples_as<std::uint8_t>(volume)[11], 1) << names;
    EXPECT_EQ(samples_as<std::uint8_t>(volume)[12], 2) << names;
  }
}

TEST_F(MetaImageVolume, TakesTwoDimensionsAndFurtherOnesOfOneSample) {
  EXPECT_EQ(
      read("NDims = 2\nBinaryData = True\nDimSize = 8 3\nElementType = MET_UCHAR\n").volume.dims,
      glm::i64vec3(8, 3, 1));
  EXPECT_EQ(read("NDims = 4\nBinaryData = True\nDimSize = 4 3 2 1\nElementType = MET_UCHAR\n")
                .volume.dims,
            glm::i64vec3(4, 3, 2));
}

TEST_F(MetaImageVolume, RefusesWhatItCannotShow) {
  expect_refused("NDims = 4\nDimSize = 2 3 2 2\nElementType = MET_UCHAR\n",
                 "4 dimensions (2 x 3 x 2 x 2)");
  expect_refused(kHead + "ElementNumberOfChannels = 3\n" + kSizes, "3 channels");
  expect_refused(kHead + "DimSize = 4 3 2\nElementType = MET_STRING\n", "MET_STRING");
  expect_refused("ObjectType = Image\nNDims = 3\nBinaryData = False\n" + kSizes, "as text");
}

TEST_F(MetaImageVolume, RefusesDamagedHeaders) {
  expect_refused(kHead + "ElementSpacing = 1 0 1\n" + kSizes, "a spacing of 0 along axis 1");
  expect_refused(kHead + "ElementSpacing = 1 -1 1\n" + kSizes, "a spacing of -1");
  expect_refused(kHead + "ElementSpacing = 1 nan 1\n" + kSizes, "ElementSpacing \"1 nan 1\"");
  expect_refused(kHead + "TransformMatrix = 1 0 0 1 0 0 0 0 1\n" + kSizes, "singular directions");
  expect_refused(kHead + "DimSize = 4 x 2\nElementType = MET_UCHAR\n", "DimSize \"4 x 2\"");
  expect_refused(kHead + "DimSize = 4 0 2\nElementType = MET_UCHAR\n", "DimSize \"4 0 2\"");
  expect_refused(kHead + "DimSize = 4 3\nElementType = MET_UCHAR\n", "damaged header");
  expect_refused("NDims = 90\n" + kSizes, "NDims \"90\"");
  expect_refused("NDims = 85271859 3\n" + kSizes, "NDims");
  expect_refused(kHead + "Comment = " + std::string(600, 'x') + "\n" + kSizes, "more than 480");
  expect_error(ErrorCode::BadFile, "an empty file",
               [&] { read_volume(folder_.write("e.mha", "")); });
  expect_error(ErrorCode::BadFile, "without ElementDataFile",
               [&] { read_volume(folder_.write("e.mha", kHead)); });
  expect_error(ErrorCode::BadFile, "no such file", [&] {
    read_volume(folder_.write("e.mhd", kHead + kSizes + "ElementDataFile = absent.raw\n"));
  });
}

TEST_F(MetaImageVolume, RefusesTruncatedSamples) {
  expect_error(ErrorCode::BadFile, "found 20 bytes for samples, expected 24",
               [&] { read(kHead + kSizes, std::string(20, 7)); });
  std::string packed = deflated(std::string(24, 7), kZlib);
  packed.resize(packed.size() - 3);
  expect_error(ErrorCode::BadFile, "without its end",
               [&] { read(kHead + "CompressedData = True\n" + kSizes, packed); });
}

TEST_F(MetaImageVolume, RefusesAClaimBeyondItsSizeBeforeAllocating) {
  expect_refused(kHead + "DimSize = 2000000000 2000000000 2000000000\nElementType = MET_UCHAR\n",
                 "expected");
  expect_refused(
      kHead + "CompressedData = True\nDimSize = 900000 900000 9\nElementType = MET_UCHAR\n",
      "as the header says");
}

}  // namespace
}  // namespace nacre

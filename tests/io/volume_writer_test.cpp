#include "io/volume_writer.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#include "io/volume_reader.h"
#include "tests/support/expect_error.h"
#include "tests/support/scratch_folder.h"

namespace nacre {
namespace {

using testing::expect_error;
using testing::read_bytes;
using testing::ScratchFolder;

/// A small volume of random bytes (finite where they are floats).
Volume noise(ScalarType type) {
  Volume volume = make_volume({5, 4, 3}, type);
  std::mt19937 random(7);
  visit_samples(volume, [&](auto samples) {
    using T = typename decltype(samples)::value_type;
    for (T& sample : samples) sample = static_cast<T>(static_cast<double>(random()) / 7.0);
  });
  return volume;
}

/// An oblique, sheared, left-handed frame without a single round number.
glm::dmat4 awkward_frame() {
  return {{0.61803398874989, 0.1, -0.2, 0},
          {-0.07, 0.9876543210123, 1.0 / 3, 0},
          {0.11, 0.3, -1.7320508075688772, 0},
          {-123.456789012345, 0.1, 1e-7, 1}};
}

struct Format {
  const char* extension;
  bool has_slope;
};

class WrittenVolume : public ::testing::TestWithParam<Format> {
 protected:
  void expect_the_same_back(const Volume& volume) const {
    const auto path = folder_.path() / (std::string("v") + GetParam().extension);
    write_volume(volume, path);
    const Volume back = read_volume(path).volume;
    EXPECT_EQ(back.dims, volume.dims);
    EXPECT_EQ(back.type, volume.type);
    ASSERT_EQ(back.samples.size(), volume.samples.size());
    EXPECT_EQ(std::memcmp(back.samples.data(), volume.samples.data(), back.samples.size()), 0);
    EXPECT_EQ(back.slope, volume.slope);
    EXPECT_EQ(back.intercept, volume.intercept);
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) {
        EXPECT_EQ(back.world_from_voxel[column][row], volume.world_from_voxel[column][row])
            << "column " << column << ", row " << row;
      }
    }
  }
  ScratchFolder folder_;
};

TEST_P(WrittenVolume, ReadsBackTheSameForEveryType) {
  for (const ScalarType type :
       {ScalarType::U8, ScalarType::I8, ScalarType::U16, ScalarType::I16, ScalarType::U32,
        ScalarType::I32, ScalarType::F32, ScalarType::F64}) {
    SCOPED_TRACE(std::string(name(type)));
    expect_the_same_back(noise(type));
  }
}

TEST_P(WrittenVolume, ReadsBackAnAwkwardFrameToTheLastBit) {
  Volume volume = noise(ScalarType::I16);
  volume.world_from_voxel = awkward_frame();
  expect_the_same_back(volume);
}

TEST_P(WrittenVolume, ReadsBackRandomFramesToTheLastBit) {
  std::mt19937 random(11);
  std::normal_distribution<double> number(0.0, 1.0);
  Volume volume = noise(ScalarType::U8);
  for (int trial = 0; trial < 50; ++trial) {
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row) {
        volume.world_from_voxel[column][row] = number(random) + (row == column ? 5.0 : 0.0);
      }
    }
    expect_the_same_back(volume);
  }
}

TEST_P(WrittenVolume, ReadsBackSlopeAndIntercept) {
  Volume volume = noise(ScalarType::I16);
  volume.slope = 0.1;
  volume.intercept = -1024.3;
  if (GetParam().has_slope) return expect_the_same_back(volume);
  expect_error(ErrorCode::Unsupported, "slope 0.1", [&] { expect_the_same_back(volume); });
  EXPECT_EQ(folder_.file_count(), 0u);
}

/// The formats that this build can also read.
std::vector<Format> readable_formats() {
  std::vector<Format> formats{{".nii", true}, {".nii.gz", true}};
#ifdef NACRE_WITH_ITK
  formats.insert(formats.end(),
                 {{".nrrd", false}, {".nhdr", false}, {".mha", true}, {".mhd", true}});
#endif
  return formats;
}

INSTANTIATE_TEST_SUITE_P(Formats, WrittenVolume, ::testing::ValuesIn(readable_formats()),
                         [](const auto& test) {
                           std::string label = test.param.extension + 1;
                           if (label == "nii.gz") label = "nii_gz";
                           return label;
                         });

TEST(VolumeWriter, UsesVersion1OfNiftiWhereItIsExact) {
  const ScratchFolder folder;
  Volume volume = noise(ScalarType::U8);
  write_volume(volume, folder.path() / "a.nii");
  EXPECT_EQ(read_volume(folder.path() / "a.nii").report.format, "NIfTI-1");
  volume.world_from_voxel[0][0] = 0.7;  // no float
  write_volume(volume, folder.path() / "b.nii");
  EXPECT_EQ(read_volume(folder.path() / "b.nii").report.format, "NIfTI-2");
}

TEST(VolumeWriter, LeavesNothingBesideItsFiles) {
  const ScratchFolder folder;
  write_volume(noise(ScalarType::U8), folder.path() / "a.mhd");
  EXPECT_EQ(folder.file_count(), 2u);
  write_volume(noise(ScalarType::U8), folder.path() / "a.nrrd");
  EXPECT_EQ(folder.file_count(), 3u);
}

TEST(VolumeWriter, WritesTheSameBytesTwice) {
  const ScratchFolder folder;
  for (const char* name : {"a.nrrd", "a.nii.gz", "a.mha"}) {
    write_volume(noise(ScalarType::U16), folder.path() / name);
    const std::string first = read_bytes(folder.path() / name);
    write_volume(noise(ScalarType::U16), folder.path() / name);
    EXPECT_EQ(first, read_bytes(folder.path() / name)) << name;
  }
}

TEST(VolumeWriter, RefusesUnknownNamesAndPlaces) {
  const ScratchFolder folder;
  const Volume volume = noise(ScalarType::U8);
  expect_error(ErrorCode::BadArgument, "extension \".vol\"",
               [&] { write_volume(volume, folder.path() / "a.vol"); });
  expect_error(ErrorCode::BadArgument, "cannot be created",
               [&] { write_volume(volume, folder.path() / "no folder" / "a.nrrd"); });
  EXPECT_EQ(folder.file_count(), 0u);
}

}  // namespace
}  // namespace nacre

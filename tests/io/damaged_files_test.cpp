// Files that were cut short or had bits and text changed must give a volume or nacre::Error: no
// other exception, no crash, no hang.
#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "io/volume_reader.h"
#include "io/volume_writer.h"
#include "tests/support/damage.h"
#include "tests/support/scratch_folder.h"
#ifdef NACRE_WITH_ITK
#include "tests/support/dicom_files.h"
#endif

namespace nacre {
namespace {

using testing::Damage;
using testing::read_bytes;
using testing::ScratchFolder;

constexpr int kTrials = 400;
constexpr int kDicomTrials = 150;  // each starts two processes

/// Reads; true if that gave a volume. Anything but nacre::Error ends the test.
bool reads(const std::filesystem::path& path) {
  try {
    return sample_count(read_volume(path).volume) > 0;
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return false;
  }
}

Volume small_volume() {
  Volume volume = make_volume({7, 6, 5}, ScalarType::I16);
  std::int16_t next = 0;
  for (std::int16_t& sample : samples_as<std::int16_t>(volume)) sample = next++;
  volume.world_from_voxel[0][0] = 0.7;
  volume.world_from_voxel[3][2] = -12.5;
  return volume;
}

class DamagedFile : public ::testing::TestWithParam<const char*> {};

TEST_P(DamagedFile, GivesAVolumeOrAnError) {
  const ScratchFolder folder;
  const auto path = folder.path() / GetParam();
  write_volume(small_volume(), path);
  const std::string whole = read_bytes(path);
  Damage damage(1);
  int refused = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::string bytes = damage.of(whole);
    folder.write(GetParam(), bytes);
    ASSERT_NO_THROW(refused += reads(path) ? 0 : 1) << "trial " << trial;
  }
  EXPECT_GT(refused, kTrials / 4);  // the damage is real
}

TEST_P(DamagedFile, CutAnywhereIsRefused) {
  const ScratchFolder folder;
  const auto path = folder.path() / GetParam();
  write_volume(small_volume(), path);
  const std::string whole = read_bytes(path);
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 40) {
    folder.write(GetParam(), whole.substr(0, size));
    EXPECT_FALSE(reads(path)) << "cut to " << size << " of " << whole.size() << " bytes";
  }
}

std::vector<const char*> files() {
  std::vector<const char*> names{"a.nii", "a.nii.gz"};
#ifdef NACRE_WITH_ITK
  names.insert(names.end(), {"a.nrrd", "a.mha"});
#endif
  return names;
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedFile, ::testing::ValuesIn(files()), [](const auto& test) {
  std::string label = test.param;
  for (char& c : label) c = c == '.' ? '_' : c;
  return label;
});

#ifdef NACRE_WITH_ITK
TEST(DamagedHeader, OfADetachedFileGivesAVolumeOrAnError) {
  const ScratchFolder folder;
  for (const char* name : {"a.nhdr", "a.mhd"}) {
    write_volume(small_volume(), folder.path() / name);
    const std::string whole = read_bytes(folder.path() / name);
    Damage damage(2);
    for (int trial = 0; trial < kTrials; ++trial) {
      folder.write(name, damage.of(whole));
      ASSERT_NO_THROW(reads(folder.path() / name)) << name << ", trial " << trial;
    }
  }
}

TEST(DamagedDicom, GivesAVolumeOrAnError) {
  const ScratchFolder folder;
  testing::DicomSliceSpec slice;
  slice.has_position = true;
  for (const bool compressed : {false, true}) {
    slice.jpeg_lossless = compressed;
    slice.position = {0, 0, 0};
    testing::write_dicom(slice, folder.path() / "a.dcm");
    slice.position = {0, 0, 3};
    testing::write_dicom(slice, folder.path() / "b.dcm");
    const std::string whole = read_bytes(folder.path() / "b.dcm");
    Damage damage(3);
    for (int trial = 0; trial < kDicomTrials; ++trial) {
      folder.write("b.dcm", damage.of(whole));
      ASSERT_NO_THROW(reads(folder.path())) << "trial " << trial;
    }
  }
}
#endif

}  // namespace
}  // namespace nacre

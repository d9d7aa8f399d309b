#include "extract/swept_surfaces.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <tbb/parallel_for.h>

#include <csignal>
#include <vector>

#include "core/error.h"
#include "extract/marching_cubes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::random_volume;
using testing::ScratchFolder;

const std::vector<double> kValues{20.5, 60.0, 99.0, 300.0};  // nothing reaches the last

void expect_same_as_in_memory(const Volume& volume, const SurfaceStorage& storage) {
  const std::vector<TriangleMesh> expected = extract_surfaces(volume, kValues);
  ExtractedSurfaces surfaces = extract_surfaces(volume, kValues, storage);
  ASSERT_EQ(surfaces.size(), expected.size());
  tbb::parallel_for(std::size_t{0}, expected.size(), [&](std::size_t k) {
    EXPECT_EQ(surfaces.triangle_count(k), expected[k].triangles.size());
    const TriangleMesh surface = surfaces.take(k);
    EXPECT_EQ(surface.positions, expected[k].positions);
    EXPECT_EQ(surface.triangles, expected[k].triangles);
  });
}

/// Files end at this size, as on a disk without more room, until it goes.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

Volume noise() { return random_volume<std::uint8_t>({9, 11, 40}, 0, 100); }

Volume left_handed_noise() {
  Volume volume = noise();
  volume.world_from_voxel[0][0] = -1.0;
  return volume;
}

TEST(SweptSurfaces, GiveTheSameSurfacesFromAFile) {
  const ScratchFolder folder;
  expect_same_as_in_memory(noise(), {.scratch_folder = folder.path()});
  expect_same_as_in_memory(left_handed_noise(), {.scratch_folder = folder.path()});
}

TEST(SweptSurfaces, GiveTheSameSurfacesHalfFromAFile) {
  const ScratchFolder folder;
  const std::size_t total = 12 * 3 * 8 * extract_surfaces(noise(), kValues)[1].triangles.size();
  expect_same_as_in_memory(noise(), {.scratch_folder = folder.path(), .memory_bytes = total / 3});
}

TEST(SweptSurfaces, StayInMemoryWhereNoFileCanBe) {
  expect_same_as_in_memory(noise(), {.scratch_folder = "/nonexistent/folder"});
}

TEST(SweptSurfaces, StayInMemoryWhereTheDiskIsFull) {
  const ScratchFolder folder;
  for (const rlim_t bytes : {0, 1000, 100'000}) {  // before, between and within slabs
    const FullDisk full(bytes);
    expect_same_as_in_memory(noise(), {.scratch_folder = folder.path()});
    expect_same_as_in_memory(left_handed_noise(), {.scratch_folder = folder.path()});
  }
}

TEST(SweptSurfaces, LeaveNoFileToSee) {
  const ScratchFolder folder;
  const ExtractedSurfaces surfaces =
      extract_surfaces(noise(), kValues, {.scratch_folder = folder.path()});
  EXPECT_GT(surfaces.triangle_count(0), 0u);
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(ScratchFile, GivesBackWhatWasWritten) {
  const ScratchFolder folder;
  auto file = ScratchFile::create(folder.path());
  ASSERT_TRUE(file);
  const std::vector<int> numbers{1, 2, 3};
  const std::uint64_t first = file->reserve(12);
  const std::uint64_t second = file->reserve(12);
  EXPECT_TRUE(file->write(second, std::as_bytes(std::span(numbers))));
  EXPECT_TRUE(file->write(first, std::as_bytes(std::span(numbers))));
  std::vector<int> back(3);
  file->read(second, std::as_writable_bytes(std::span(back)));
  EXPECT_EQ(back, numbers);
  EXPECT_THROW(file->read(second + 12, std::as_writable_bytes(std::span(back))), Error);
}

}  // namespace
}  // namespace nacre

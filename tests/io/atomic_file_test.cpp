#include "io/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "tests/support/expect_error.h"
#include "tests/support/scratch_folder.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

using testing::expect_error;
using testing::read_bytes;
using testing::ScratchFolder;

TEST(AtomicFile, AppearsUnderItsNameWhenCommitted) {
  const ScratchFolder folder;
  AtomicFile file(folder.path() / "a.txt");
  file.write(std::string_view("whole"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.txt"));
  file.commit();
  EXPECT_EQ(read_bytes(folder.path() / "a.txt"), "whole");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, ClosedKeepsItsTemporaryNameUntilCommitted) {
  const ScratchFolder folder;
  AtomicFile file(folder.path() / "a.txt");
  file.write(std::string_view("whole"));
  file.close();
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.txt"));
  EXPECT_EQ(read_bytes(file.temporary_path()), "whole");
  file.commit();
  EXPECT_EQ(read_bytes(folder.path() / "a.txt"), "whole");
}

TEST(AtomicFile, LeavesTheOldFileAndNothingElseWithoutCommit) {
  const ScratchFolder folder;
  folder.write("a.txt", "old");
  {
    AtomicFile file(folder.path() / "a.txt");
    file.write(std::string_view("half"));
  }
  EXPECT_EQ(read_bytes(folder.path() / "a.txt"), "old");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, ReplacesWhatASymbolicLinkPointsTo) {
  const ScratchFolder folder;
  folder.write("real.txt", "old");
  std::filesystem::create_symlink("real.txt", folder.path() / "link.txt");
  AtomicFile file(folder.path() / "link.txt");
  file.write(std::string_view("new"));
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.txt"));
  EXPECT_EQ(read_bytes(folder.path() / "real.txt"), "new");
}

TEST(AtomicFile, WritesToADeviceInPlace) {
  AtomicFile file("/dev/null");
  file.write(std::string_view("gone"));
  file.commit();
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, ReplacesAFileThatOthersKeepReading) {
  const ScratchFolder folder;
  std::ifstream old(folder.write("a.txt", "old"));
  AtomicFile file(folder.path() / "a.txt");
  file.write(std::string_view("new"));
  file.commit();
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(old), {}), "old");
  EXPECT_EQ(read_bytes(folder.path() / "a.txt"), "new");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, LeavesNothingBehindWhenKilled) {
  const ScratchFolder folder;
  const fs::path path = folder.write("a.txt", "old");
  if (!AtomicFile(path).temporary_path().empty()) {
    GTEST_SKIP() << "no files without a name on this file system";
  }
  const pid_t child = fork();
  if (child == 0) {
    AtomicFile file(path);
    file.write(std::string_view("half"));
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(read_bytes(path), "old");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, MayBeReadByWhomTheUmaskLets) {
  const ScratchFolder folder;
  const mode_t before = umask(027);
  AtomicFile file(folder.path() / "a.txt");
  file.commit();
  umask(before);
  EXPECT_EQ(fs::status(folder.path() / "a.txt").permissions(), fs::perms(0640));
}

TEST(AtomicFile, ReportsAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  expect_error(ErrorCode::Unsupported, "cannot be written", [] {
    AtomicFile file("/dev/full");
    file.write(std::string_view("more than there is room for"));
    file.commit();
  });
}

TEST(AtomicFile, RefusesFoldersAndPlacesThatAreNotThere) {
  const ScratchFolder folder;
  expect_error(ErrorCode::BadArgument, "found a folder", [&] { AtomicFile file(folder.path()); });
  expect_error(ErrorCode::BadArgument, "cannot be created",
               [&] { AtomicFile file(folder.path() / "no" / "a.txt"); });
}

}  // namespace
}  // namespace nacre

#include "io/pose_file.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"
#include "tests/support/scratch_folder.h"

namespace nacre {
namespace {

using testing::expect_error;
using testing::ScratchFolder;

void expect_refusal(const std::string& text, const std::string& part) {
  const ScratchFolder folder;
  const auto path = folder.write("pose.txt", text);
  expect_error(ErrorCode::BadFile, part, [&] { read_pose(path); });
}

TEST(PoseFile, IsReadRowByRow) {
  const ScratchFolder folder;
  const glm::dmat4 pose = read_pose(
      folder.write("pose.txt",
                   "# from the planning station\r\n0 -1 0 10.5\r\n1,0,0,20 # y\r\n0, 0, 1, -3e1\n"
                   "0 0\n0 +1\n"));
  EXPECT_EQ(pose * glm::dvec4(1, 2, 3, 1), glm::dvec4(8.5, 21, -27, 1));
}

TEST(PoseFile, RefusesOtherNumbersOfNumbers) {
  expect_refusal("", "0 numbers");
  expect_refusal("1 0 0 0 0 1 0 0 0 0 1 0", "12 numbers");
  expect_refusal("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 1", "17 numbers");
  expect_refusal("1 0 0 0 0 1 0 0 0 0 1 nan 0 0 0 1", "\"nan\" in line 1");
  expect_refusal("1 0 0 x", "\"x\" in line 1");
  expect_refusal(std::string("\0\1\2", 3), "in line 1");
}

TEST(PoseFile, RefusesWhatIsNoRigidMotion) {
  expect_refusal("0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 1", "determinant 0 ");        // singular
  expect_refusal("2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1", "scale=");                // a size
  expect_refusal("1 0 0 0 0 1 0 0 0 0 -1 0 0 0 0 1", "determinant -1 ");      // a mirror image
  expect_refusal("1 0.001 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "a rigid pose");      // a shear
  expect_refusal("1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1", "the last row 5 6 7 1");  // columns for rows
}

TEST(PoseFile, TakesRotationsWrittenWithFiveDigits) {
  const ScratchFolder folder;
  EXPECT_NO_THROW(
      read_pose(folder.write("pose.txt", "0.86603 -0.5 0 1\n0.5 0.86603 0 2\n0 0 1 3\n0 0 0 1\n")));
}

TEST(PoseFile, RefusesFilesThatAreNotThere) {
  expect_error(ErrorCode::BadFile, "No such file", [] { read_pose("no/pose.txt"); });
}

}  // namespace
}  // namespace nacre

#include "io/slice_stack.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/volume_geometry.h"
#include "tests/support/expect_error.h"

namespace nacre {
namespace {

using testing::expect_error;

constexpr double kRounding = 1e-12;

/// Axial slices at multiples of `step`.
std::vector<SliceFrame> slices_along(const glm::dvec3& step, int count) {
  std::vector<SliceFrame> slices;
  for (int i = 0; i < count; ++i) {
    slices.push_back({.position = glm::dvec3(10, 20, 30) + static_cast<double>(i) * step,
                      .x_direction = {1, 0, 0},
                      .y_direction = {0, 1, 0},
                      .spacing_mm = {0.5, 0.75},
                      .thickness_mm = 99});
  }
  return slices;
}

SliceStack stack(const std::vector<SliceFrame>& slices, std::size_t expected_warnings = 0) {
  VolumeReadReport report;
  SliceStack result = stack_slices("s", slices, report);
  EXPECT_EQ(report.warnings.size(), expected_warnings);
  return result;
}

void expect_refused(const std::vector<SliceFrame>& slices, const std::string& part) {
  VolumeReadReport report;
  expect_error(ErrorCode::BadFile, part, [&] { stack_slices("s", slices, report); });
}

TEST(SliceStack, OrdersByPositionAndSpacesByIt) {
  std::vector<SliceFrame> slices = slices_along({0, 0, 7}, 5);
  std::swap(slices[0], slices[3]);
  const SliceStack result = stack(slices);
  EXPECT_EQ(result.order, (std::vector<std::size_t>{3, 1, 2, 0, 4}));
  EXPECT_EQ(glm::dvec3(result.world_from_voxel[0]), glm::dvec3(0.5, 0, 0));
  EXPECT_EQ(glm::dvec3(result.world_from_voxel[1]), glm::dvec3(0, 0.75, 0));
  EXPECT_EQ(glm::dvec3(result.world_from_voxel[2]), glm::dvec3(0, 0, 7));
  EXPECT_EQ(glm::dvec3(result.world_from_voxel[3]), glm::dvec3(10, 20, 30));
}

TEST(SliceStack, IsRightHandedWhateverTheOrderOfTheFiles) {
  EXPECT_GT(handedness(stack(slices_along({0, 0, -7}, 5)).world_from_voxel), 0);
}

TEST(SliceStack, KeepsTheTiltOfAGantryAsAnExactShear) {
  const double tilt = 0.3;  // radians
  const glm::dvec3 step(0, 5 * std::sin(tilt), 5 * std::cos(tilt));
  const SliceStack result = stack(slices_along(step, 9));
  for (int row = 0; row < 3; ++row) {
    EXPECT_NEAR(result.world_from_voxel[2][row], step[row], kRounding);
  }
  EXPECT_NEAR(shear_rad(result.world_from_voxel), tilt, kRounding);
}

TEST(SliceStack, WarnsOfSlightlyUnevenSlicesAndRefusesAMissingOne) {
  std::vector<SliceFrame> slices = slices_along({0, 0, 5}, 9);
  slices[4].position.z += 0.004;  // 0.08 %
  stack(slices);
  slices[4].position.z += 0.2;  // 4 %
  stack(slices, 1);
  slices[4].position.z += 0.4;  // 12 %
  expect_refused(slices, "between slices 4 and 5");
  slices = slices_along({0, 0, 5}, 9);
  slices.erase(slices.begin() + 4);
  expect_refused(slices, "found 10 mm between slices 4 and 5, expected 5 mm");
}

TEST(SliceStack, WarnsOfSlicesSlightlyBesideTheLineAndRefusesMore) {
  std::vector<SliceFrame> slices = slices_along({0, 0, 5}, 9);
  slices[4].position.x += 0.004;  // under a hundredth of the 0.5 mm pixel
  stack(slices);
  slices[4].position.x += 0.02;
  stack(slices, 1);
  slices[4].position.x += 0.1;
  expect_refused(slices, "beside a straight line");
}

TEST(SliceStack, RefusesSharedPositions) {
  std::vector<SliceFrame> slices = slices_along({0, 0, 5}, 4);
  slices.push_back(slices[2]);
  expect_refused(slices, "5 slices at 4 positions");
  const std::vector<SliceFrame> once = slices_along({0, 0, 5}, 4);
  slices = once;
  for (int repeat = 0; repeat < 2; ++repeat) slices.insert(slices.end(), once.begin(), once.end());
  expect_refused(slices, "12 slices at 4 positions");
  expect_refused(slices_along({0, 0, 0}, 3), "3 slices at 1 positions");
}

TEST(SliceStack, RefusesMixedOrientationsAndSpacings) {
  std::vector<SliceFrame> slices = slices_along({0, 0, 5}, 4);
  slices[2].x_direction = {0, 0, 1};
  expect_refused(slices, "more than one orientation");
  slices = slices_along({0, 0, 5}, 4);
  slices[2].spacing_mm.x = 0.6;
  expect_refused(slices, "more than one pixel spacing");
}

TEST(SliceStack, RefusesFramesThatAreNone) {
  std::vector<SliceFrame> slices = slices_along({0, 0, 5}, 2);
  slices[1].spacing_mm.y = 0;
  expect_refused(slices, "a pixel spacing of 0.5 x 0 mm");
  slices = slices_along({0, 0, 5}, 2);
  slices[0].y_direction = {0, 0, 0};
  expect_refused(slices, "a direction of length 0");
}

TEST(SliceStack, TakesTheThicknessOfALoneSliceAndSaysSo) {
  EXPECT_EQ(stack(slices_along({0, 0, 5}, 1), 1).world_from_voxel[2][2], 99);
}

}  // namespace
}  // namespace nacre

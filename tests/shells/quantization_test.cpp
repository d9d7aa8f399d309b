#include "shells/quantization.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "core/error.h"
#include "core/quantization_grid.h"

namespace nacre {
namespace {

glm::dmat4 spaced(double x, double y, double z) {
  return glm::scale(glm::dmat4(1.0), glm::dvec3(x, y, z));
}

void expect_holds_box(const QuantizationGrid& grid, const glm::i64vec3& dims,
                      const glm::dmat4& world_from_voxel) {
  EXPECT_TRUE(is_exact(grid));
  const glm::dvec3 corner =
      0.5 * glm::dvec3(glm::dmat4(world_from_voxel) * glm::dvec4(dims - std::int64_t{1}, 0.0));
  for (const glm::dvec3& p : {corner, -corner}) {
    const glm::dvec3 snapped(grid_position(grid, nearest_index(grid, p)));
    const double error = glm::length(snapped - p);
    EXPECT_LE(error, std::sqrt(0.75) * step_mm(grid) * 1.0000001);
  }
}

TEST(Quantization, TakesTheFewestBitsWithASmallEnoughStep) {
  const GridChoice choice = choose_grid({256, 256, 124}, spaced(0.43, 0.43, 0.8));
  EXPECT_EQ(choice.grid.bits, 14);  // 255 * 64 = 16320
  EXPECT_LE(choice.step_spacings, 1.0 / 64.0);
  EXPECT_GT(choice.step_spacings, 0.998 / 64.0);
  EXPECT_FALSE(choice.is_coarse);
  expect_holds_box(choice.grid, {256, 256, 124}, spaced(0.43, 0.43, 0.8));
}

TEST(Quantization, HasTwelveBitsForASmallVolume) {
  const GridChoice choice = choose_grid({20, 10, 3}, spaced(1.0, 2.0, 3.0));
  EXPECT_EQ(choice.grid.bits, 12);
  EXPECT_LT(choice.step_mm, 1.0 / 200.0);
  expect_holds_box(choice.grid, {20, 10, 3}, spaced(1.0, 2.0, 3.0));
}

TEST(Quantization, CoversEveryShapeExactly) {
  for (const double spacing : {1e-7, 0.1, 1.0 / 3.0, 0.9375, 3.0, 1e6}) {
    for (const std::int64_t size : {1, 2, 63, 64, 100, 511, 2048, 30'000}) {
      const glm::i64vec3 dims(size, 3, 7);
      const glm::dmat4 matrix =
          glm::rotate(spaced(spacing, spacing * 2.0, spacing), 0.3, glm::dvec3(1, 2, 3));
      const GridChoice choice = choose_grid(dims, matrix);
      EXPECT_FALSE(choice.is_coarse);
      if (size > 1) expect_holds_box(choice.grid, dims, matrix);
    }
  }
}

TEST(Quantization, SaysWhenFloatsHaveNoMoreBits) {
  const GridChoice choice = choose_grid({512, 512, 512}, spaced(1.0, 1.0, 1000.0));
  EXPECT_EQ(choice.grid.bits, kMaxGridBits);
  EXPECT_TRUE(choice.is_coarse);
  EXPECT_GT(choice.step_spacings, 1.0 / 64.0);
  EXPECT_LT(choice.step_spacings, 1.0 / 8.0);
  expect_holds_box(choice.grid, {512, 512, 512}, spaced(1.0, 1.0, 1000.0));
}

TEST(Quantization, TakesTheBitsAskedFor) {
  for (int bits = kMinGridBits; bits <= kMaxGridBits; ++bits) {
    const GridChoice choice = choose_grid({256, 256, 124}, spaced(0.43, 0.43, 0.8), {.bits = bits});
    EXPECT_EQ(choice.grid.bits, bits);
    EXPECT_TRUE(is_exact(choice.grid)) << bits;
    EXPECT_EQ(choice.is_coarse, bits < 14) << bits;
  }
  EXPECT_THROW(choose_grid({2, 2, 2}, spaced(1, 1, 1), {.bits = 24}), Error);
  EXPECT_THROW(choose_grid({2, 2, 2}, spaced(1, 1, 1), {.bits = -1}), Error);
}

TEST(Quantization, RefusesWhatFloatsCannotHold) {
  EXPECT_THROW(choose_grid({2, 2, 2}, spaced(1e-35, 1, 1)), Error);
  EXPECT_THROW(choose_grid({2, 2, 2}, spaced(1, 1, 1e35)), Error);
}

}  // namespace
}  // namespace nacre

#include "core/quantization_grid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nacre {
namespace {

/// The grid of `bits` bits, step `odd` * 2^exponent, around the origin.
QuantizationGrid grid_of(int bits, double odd, int exponent) {
  const double step = std::ldexp(odd, exponent);
  const double count = std::ldexp(1.0, bits);
  return {glm::dvec3(-step * count / 2.0), step * (count - 1.0), bits};
}

TEST(QuantizationGrid, IsExactWhileFloatsHoldEveryPoint) {
  EXPECT_TRUE(is_exact(grid_of(12, 1.0, -6)));
  EXPECT_TRUE(is_exact(grid_of(12, 4095.0, -20)));
  EXPECT_FALSE(is_exact(grid_of(12, 8191.0, -20)));  // 13 + 12 bits
  EXPECT_TRUE(is_exact(grid_of(23, 1.0, -10)));
  EXPECT_FALSE(is_exact(grid_of(24, 1.0, -10)));
  EXPECT_FALSE(is_exact({glm::dvec3(0.1), 4095.0, 12}));         // origin off the lattice
  EXPECT_FALSE(is_exact({glm::dvec3(1e9), 4095.0 / 64.0, 12}));  // too far out for a float
  EXPECT_FALSE(is_exact({glm::dvec3(0.0), 0.1, 12}));
  EXPECT_FALSE(is_exact({glm::dvec3(0.0), std::nan(""), 12}));
  EXPECT_FALSE(is_exact({glm::dvec3(0.0), 1.0, 0}));
}

TEST(QuantizationGrid, FindsTheNearestPointAndStaysInside) {
  const QuantizationGrid grid{glm::dvec3(-8.0), 15.0, 4};  // step 1, from -8 to 7
  EXPECT_EQ(nearest_index(grid, {-8.0, 0.4, 0.6}), glm::ivec3(0, 8, 9));
  EXPECT_EQ(nearest_index(grid, {-99.0, 99.0, std::nan("")}), glm::ivec3(0, 15, 0));
  EXPECT_EQ(grid_position(grid, {0, 8, 15}), glm::vec3(-8.0f, 0.0f, 7.0f));
}

TEST(QuantizationGrid, KnowsItsOwnPoints) {
  const QuantizationGrid grid = grid_of(14, 5.0, -9);
  EXPECT_TRUE(is_on(grid, grid_position(grid, {0, 777, 16383})));
  EXPECT_FALSE(is_on(grid, grid_position(grid, {0, 777, 16383}) + glm::vec3(0, 1e-4f, 0)));
  EXPECT_FALSE(is_on(grid, {1e9f, 0.0f, 0.0f}));
  EXPECT_FALSE(is_on(grid, {NAN, 0.0f, 0.0f}));
}

}  // namespace
}  // namespace nacre

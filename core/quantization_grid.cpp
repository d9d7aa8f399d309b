#include "core/quantization_grid.h"

#include <algorithm>
#include <cmath>

namespace nacre {
namespace {

constexpr double kFloatIntegers = 16'777'216.0;  // 2^24: integers up to here are floats
constexpr int kSafeBits = 20;  // up to here a rounded 1 / step does not move an index
// Steps beyond these would leave the range of normal floats somewhere on the way.
constexpr int kMinExponent = -100;
constexpr int kMaxExponent = 100;

double last_index(const QuantizationGrid& grid) noexcept {
  return std::ldexp(1.0, grid.bits) - 1.0;
}

/// A positive value as m * 2^e with an odd integer m.
struct OddTimesPower {
  double odd;
  int exponent;
};

OddTimesPower odd_times_power(double value) noexcept {
  int exponent = 0;
  double odd = std::ldexp(std::frexp(value, &exponent), 53);
  exponent -= 53;
  while (std::fmod(odd, 2.0) == 0.0) {
    odd *= 0.5;
    ++exponent;
  }
  return {odd, exponent};
}

bool is_integer_up_to(double value, double limit) noexcept {
  return std::abs(value) <= limit && std::trunc(value) == value;
}

}  // namespace

double step_mm(const QuantizationGrid& grid) noexcept { return grid.range_mm / last_index(grid); }

bool is_exact(const QuantizationGrid& grid) noexcept {
  if (grid.bits < kMinGridBits || grid.bits > kMaxGridBits) return false;
  if (!std::isfinite(grid.range_mm) || grid.range_mm <= 0.0) return false;
  const double step = step_mm(grid);
  const auto [odd, exponent] = odd_times_power(step);
  if (exponent < kMinExponent || exponent > kMaxExponent) return false;
  if (step * last_index(grid) != grid.range_mm) return false;
  if (std::ldexp(odd, grid.bits) > kFloatIntegers) return false;
  if (grid.bits > kSafeBits && odd != 1.0) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = std::ldexp(grid.origin_mm[axis], -exponent);
    const double hi = std::ldexp(grid.origin_mm[axis] + grid.range_mm, -exponent);
    if (!is_integer_up_to(lo, kFloatIntegers) || !is_integer_up_to(hi, kFloatIntegers)) {
      return false;
    }
  }
  return true;
}

double unit_mm(const QuantizationGrid& grid) noexcept {
  return std::ldexp(1.0, odd_times_power(step_mm(grid)).exponent);
}

glm::vec3 grid_position(const QuantizationGrid& grid, const glm::ivec3& index) noexcept {
  const glm::vec3 position(grid.origin_mm + step_mm(grid) * glm::dvec3(index));
  return position;
}

glm::ivec3 nearest_index(const QuantizationGrid& grid, const glm::dvec3& position_mm) noexcept {
  const double step = step_mm(grid);
  glm::ivec3 index;
  for (int axis = 0; axis < 3; ++axis) {
    const double i = std::floor((position_mm[axis] - grid.origin_mm[axis]) / step + 0.5);
    // Written so that NaN becomes 0.
    index[axis] = i > 0.0 ? static_cast<int>(std::min(i, last_index(grid))) : 0;
  }
  return index;
}

bool is_on(const QuantizationGrid& grid, const glm::vec3& position_mm) noexcept {
  return grid_position(grid, nearest_index(grid, position_mm)) == position_mm;
}

}  // namespace nacre

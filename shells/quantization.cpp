#include "shells/quantization.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/quantization_grid.h"
#include "core/volume_geometry.h"

namespace nacre {
namespace {

constexpr int kUsualBits = 12;
constexpr int kFloatBits = 24;
constexpr int kSafeBits = 20;     // beyond these the step must be a power of two
constexpr int kMaxStepBits = 12;  // of m in m * 2^e; more would gain under a thousandth
// At each side, for vertices that have to make way, and those that go outwards.
constexpr double kMarginSteps = 3.0;

/// Half the extent of the volume's box along each LPS axis.
glm::dvec3 half_extent_mm(const glm::i64vec3& dims, const glm::dmat4& world_from_voxel) {
  const VoxelBox box = voxel_box(dims);
  const glm::dvec3 half = 0.5 * (box.hi - box.lo);
  glm::dvec3 extent(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    for (int column = 0; column < 3; ++column) {
      extent[axis] += half[column] * std::abs(world_from_voxel[column][axis]);
    }
  }
  return extent;
}

/// Bits that m may have in a step m * 2^e, so that m * 2^bits is a float's integer. One is lost to
/// the origin, which lies a little more than half the grid away.
int step_bits(int bits) { return bits > kSafeBits ? 1 : std::min(kMaxStepBits, kFloatBits - bits); }

/// The nearest m * 2^e with m < 2^step_bits, not above (or not below) a positive value.
double rounded_step(double value, int bits, bool up) {
  const double unit = std::ldexp(1.0, std::ilogb(value) + 1 - step_bits(bits));
  return unit * (up ? std::ceil(value / unit) : std::floor(value / unit));
}

double steps_across(int bits) { return std::ldexp(1.0, bits) - 1.0 - 2.0 * kMarginSteps; }

/// The smallest step with which `bits` span the box; the margin needs a grid of some size.
double least_step(double extent_mm, int bits) {
  return rounded_step(extent_mm / std::max(steps_across(bits), 1.0), bits, true);
}

void check_range(double extent_mm, double step) {
  if (!(std::isfinite(extent_mm) && extent_mm < 1e30 && step > 1e-30)) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("quantisation grid: found a box of {} mm and a step of {} mm, expected "
                            "1e-30 to 1e30",
                            extent_mm, step));
  }
}

}  // namespace

GridChoice choose_grid(const glm::i64vec3& dims, const glm::dmat4& world_from_voxel,
                       const GridOptions& options) {
  if (options.bits != 0 && (options.bits < kMinGridBits || options.bits > kMaxGridBits)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("quantisation: found {} bits, expected {} to {}", options.bits,
                            kMinGridBits, kMaxGridBits));
  }
  const glm::dvec3 half = half_extent_mm(dims, world_from_voxel);
  const double extent = 2.0 * std::max({half.x, half.y, half.z});
  const glm::dvec3 spacing = spacing_mm(world_from_voxel);
  const double smallest_spacing = std::min({spacing.x, spacing.y, spacing.z});
  const double wanted = options.largest_step_spacings * smallest_spacing;
  check_range(extent, wanted);

  int bits = options.bits != 0 ? options.bits : kUsualBits;
  if (options.bits == 0) {
    while (bits < kMaxGridBits && least_step(extent, bits) > wanted) ++bits;
  }
  double step = least_step(extent, bits);
  // A larger step where there is room for it makes smaller files.
  if (options.bits == 0 && bits > kUsualBits && step <= wanted) {
    step = std::max(step, rounded_step(wanted, bits, false));
  }
  GridChoice choice;
  choice.grid.bits = bits;
  choice.grid.range_mm = step * (std::ldexp(1.0, bits) - 1.0);
  choice.grid.origin_mm = step * (glm::floor(-half / step) - kMarginSteps);
  choice.step_mm = step;
  choice.step_spacings = step / smallest_spacing;
  choice.is_coarse = step > wanted;
  return choice;
}

}  // namespace nacre

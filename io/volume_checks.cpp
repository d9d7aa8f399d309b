#include "io/volume_checks.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>

#include "core/volume_geometry.h"
#include "io/bad_file.h"

namespace nacre {
namespace {

constexpr double kSmallestSpacing = 1e-9;
constexpr double kLargestSpacing = 1e9;
constexpr double kFarthestOrigin = 1e12;
constexpr double kSmallestHandedness = 0.01;
constexpr double kShearWorthAWord = 0.1 * std::numbers::pi / 180.0;

bool is_finite(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(matrix[column][row])) return false;
    }
  }
  return true;
}

}  // namespace

void check_geometry(const std::filesystem::path& path, const glm::dmat4& world_from_voxel,
                    VolumeReadReport& report) {
  if (!is_finite(world_from_voxel)) {
    throw_bad_file(path, "a spacing, direction or origin that is not finite", "finite numbers");
  }
  const glm::dvec3 spacing = spacing_mm(world_from_voxel);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(spacing[axis] >= kSmallestSpacing && spacing[axis] <= kLargestSpacing)) {
      throw_bad_file(path, fmt::format("a spacing of {} mm along axis {}", spacing[axis], axis),
                     "1e-9 to 1e9 mm");
    }
    if (std::abs(world_from_voxel[3][axis]) > kFarthestOrigin) {
      throw_bad_file(path, fmt::format("an origin at {} mm", world_from_voxel[3][axis]),
                     "at most 1e12 mm");
    }
  }
  const double cell = handedness(world_from_voxel);
  if (!(std::abs(cell) >= kSmallestHandedness)) {
    throw_bad_file(path, fmt::format("singular directions (determinant {:.3g})", cell),
                   "three independent axes");
  }
  const double shear = shear_rad(world_from_voxel);
  if (shear > kShearWorthAWord) {
    report.warnings.push_back(
        fmt::format("sheared by {:.3g} degrees; kept exactly", shear * 180.0 / std::numbers::pi));
  }
}

void set_scaling(const std::filesystem::path& path, double slope, double intercept,
                 Volume& volume) {
  if (!std::isfinite(slope) || slope == 0.0 || !std::isfinite(intercept)) {
    throw_bad_file(path, fmt::format("slope {} and intercept {}", slope, intercept),
                   "finite numbers, the slope not 0");
  }
  volume.slope = slope;
  volume.intercept = intercept;
}

}  // namespace nacre

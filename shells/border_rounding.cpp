#include "shells/border_rounding.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "core/error.h"
#include "core/quantization_grid.h"
#include "shells/grid_points.h"

namespace nacre {
namespace {

constexpr double kNearPlane = 0.01;  // voxels
// Voxels: a grid point this far within a plane lies on it, but for the rounding of the matrix.
constexpr double kOnPlane = 1e-6;
// Steps: what is nearer than the grid points that are farther along an axis.
constexpr double kNearestBeyond = 1.5;

}  // namespace

BorderRounding::BorderRounding(const ShellSet& set) {
  if (!set.grid || !is_stated(set.volume)) {
    throw Error(ErrorCode::BadArgument,
                "shell set: found no quantisation grid or no volume, expected both");
  }
  grid_ = *set.grid;
  box_ = voxel_box(set.volume.dims);
  voxel_from_local_ = voxel_from_local(set.volume.dims, set.volume.world_from_voxel);
  local_from_voxel_ = glm::inverse(voxel_from_local_);
}

unsigned BorderRounding::planes_at(const glm::dvec3& p_mm) const {
  const glm::dvec3 p = voxel(p_mm);
  unsigned planes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] <= box_.lo[axis] + kNearPlane) planes |= 1U << (2 * axis);
    if (p[axis] >= box_.hi[axis] - kNearPlane) planes |= 2U << (2 * axis);
  }
  return planes;
}

/// A position on the planes that it lies a little within.
glm::dvec3 BorderRounding::onto(const glm::dvec3& p_mm, unsigned planes) const {
  glm::dvec3 p = voxel(p_mm);
  for (int axis = 0; axis < 3; ++axis) {
    if ((planes & (1U << (2 * axis))) != 0) p[axis] = std::min(p[axis], box_.lo[axis]);
    if ((planes & (2U << (2 * axis))) != 0) p[axis] = std::max(p[axis], box_.hi[axis]);
  }
  return glm::dvec3(local_from_voxel_ * glm::dvec4(p, 1.0));
}

/// How far a position lies within one of the planes at most.
double BorderRounding::inward_voxels(const glm::dvec3& p_mm, unsigned planes) const {
  const glm::dvec3 p = voxel(p_mm);
  double most = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    if ((planes & (1U << (2 * axis))) != 0) most = std::max(most, p[axis] - box_.lo[axis]);
    if ((planes & (2U << (2 * axis))) != 0) most = std::max(most, box_.hi[axis] - p[axis]);
  }
  return most > kOnPlane ? most : 0.0;
}

glm::ivec3 BorderRounding::index(const glm::dvec3& p_mm) const {
  const unsigned planes = planes_at(p_mm);
  if (planes == 0) return nearest_index(grid_, p_mm);
  const glm::dvec3 target = onto(p_mm, planes);
  const glm::ivec3 nearest = nearest_index(grid_, target);
  const double step = step_mm(grid_);
  glm::ivec3 best = nearest;
  double least_inward = std::numeric_limits<double>::infinity();
  double least_steps = std::numeric_limits<double>::infinity();
  for (const int reach : {1, 2}) {
    for (int z = -reach; z <= reach; ++z) {
      for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
          const glm::ivec3 index = nearest + glm::ivec3(x, y, z);
          if (!is_in_grid(index, grid_.bits)) continue;
          const glm::dvec3 point(grid_position(grid_, index));
          const double inward = inward_voxels(point, planes);
          const double steps = glm::distance(point, target) / step;
          if (inward > least_inward || (inward == least_inward && steps >= least_steps)) continue;
          best = index;
          least_inward = inward;
          least_steps = steps;
        }
      }
    }
    if (least_inward == 0.0 && least_steps <= kNearestBeyond) break;
  }
  return best;
}

}  // namespace nacre

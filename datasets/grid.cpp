#include "datasets/grid.h"

namespace nacre {

glm::dmat4 centered_grid(const glm::i64vec3& size, const glm::dvec3& extent_mm) {
  glm::dmat4 world_from_voxel(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto count = static_cast<double>(size[axis]);
    const double spacing_mm = extent_mm[axis] / count;
    world_from_voxel[axis][axis] = spacing_mm;
    world_from_voxel[3][axis] = -0.5 * (count - 1.0) * spacing_mm;
  }
  return world_from_voxel;
}

}  // namespace nacre

#include "shells/border_planes.h"

#include <algorithm>
#include <cstdint>

#include "core/quantization_grid.h"
#include "core/volume_geometry.h"
#include "shells/surface_emission.h"

namespace nacre {

BorderPlanes::BorderPlanes(const ShellSet& set)
    : box_(voxel_box(set.volume.dims)),
      voxel_from_local_(voxel_from_local(set.volume.dims, set.volume.world_from_voxel)),
      border_voxels_(kOnBorderVoxels) {
  const double half_step = set.grid ? 0.5 * step_mm(*set.grid) : 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3 moved = half_step * glm::abs(glm::dvec3(voxel_from_local_[axis]));
    border_voxels_ += std::max({moved.x, moved.y, moved.z});
  }
}

std::vector<glm::uvec3> BorderPlanes::triangles_off(const TriangleMesh& mesh) const {
  std::vector<std::uint8_t> planes;
  planes.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions) {
    planes.push_back(static_cast<std::uint8_t>(planes_at(p)));
  }
  std::vector<glm::uvec3> off;
  off.reserve(mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) {
    if ((planes[t.x] & planes[t.y] & planes[t.z]) == 0) off.push_back(t);
  }
  return off;
}

unsigned BorderPlanes::planes_at(const glm::vec3& p_mm) const {
  const glm::dvec3 p(voxel_from_local_ * glm::dvec4(p_mm, 1.0));
  unsigned planes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] <= box_.lo[axis] + border_voxels_) planes |= 1U << (2 * axis);
    if (p[axis] >= box_.hi[axis] - border_voxels_) planes |= 2U << (2 * axis);
  }
  return planes;
}

}  // namespace nacre

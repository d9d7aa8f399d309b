#include "core/volume_geometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace nacre {

VoxelBox voxel_box(const glm::i64vec3& dims) {
  VoxelBox box{};
  for (int axis = 0; axis < 3; ++axis) {
    const bool single = dims[axis] == 1;
    box.lo[axis] = single ? -0.5 : 0.0;
    box.hi[axis] = single ? 0.5 : static_cast<double>(dims[axis] - 1);
  }
  return box;
}

glm::dmat4 voxel_from_local(const glm::i64vec3& dims, const glm::dmat4& world_from_voxel) {
  const VoxelBox box = voxel_box(dims);
  glm::dmat4 local_from_voxel(glm::dmat3{world_from_voxel});
  const glm::dvec3 center = 0.5 * (box.lo + box.hi);
  local_from_voxel[3] = glm::dvec4(-glm::dvec3(local_from_voxel * glm::dvec4(center, 0.0)), 1.0);
  return glm::inverse(local_from_voxel);
}

BoundingSphere bounding_sphere(const glm::i64vec3& dims, const glm::dmat4& world_from_voxel) {
  const VoxelBox box = voxel_box(dims);
  const glm::dvec3 center_voxel = 0.5 * (box.lo + box.hi);
  const glm::dvec3 extent = box.hi - box.lo;
  BoundingSphere sphere;
  sphere.center_mm = glm::dvec3(world_from_voxel * glm::dvec4(center_voxel, 1.0));
  sphere.radius_mm = 0.0;
  // The four diagonals of the box; equal for an orthogonal grid, not for a sheared one.
  for (const glm::dvec3 sign :
       {glm::dvec3(1, 1, 1), glm::dvec3(-1, 1, 1), glm::dvec3(1, -1, 1), glm::dvec3(1, 1, -1)}) {
    const glm::dvec3 diagonal(world_from_voxel * glm::dvec4(sign * extent, 0.0));
    sphere.radius_mm = std::max(sphere.radius_mm, 0.5 * glm::length(diagonal));
  }
  return sphere;
}

glm::dvec3 spacing_mm(const glm::dmat4& world_from_voxel) {
  return {glm::length(glm::dvec3(world_from_voxel[0])),
          glm::length(glm::dvec3(world_from_voxel[1])),
          glm::length(glm::dvec3(world_from_voxel[2]))};
}

double shear_rad(const glm::dmat4& world_from_voxel) {
  double worst = 0.0;
  for (int first = 0; first < 3; ++first) {
    const int second = (first + 1) % 3;
    const glm::dvec3 a = glm::normalize(glm::dvec3(world_from_voxel[first]));
    const glm::dvec3 b = glm::normalize(glm::dvec3(world_from_voxel[second]));
    worst = std::max(worst, std::abs(std::asin(std::clamp(glm::dot(a, b), -1.0, 1.0))));
  }
  return worst;
}

double handedness(const glm::dmat4& world_from_voxel) {
  const glm::dvec3 spacing = spacing_mm(world_from_voxel);
  // Each column is normalised before the product: spacings may differ by many orders.
  glm::dmat3 axes(world_from_voxel);
  for (int axis = 0; axis < 3; ++axis) axes[axis] /= spacing[axis];
  return glm::determinant(axes);
}

}  // namespace nacre

#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/volume.h"

namespace nacre {

/// An interval box in voxel coordinates (sample (0,0,0) at the origin, unit spacing).
struct VoxelBox {
  glm::dvec3 lo;
  glm::dvec3 hi;
};

/// Where the trilinear field is defined: from the first to the last sample along each axis; an axis
/// of one sample spans [-1/2, 1/2], one spacing.
VoxelBox voxel_box(const glm::i64vec3& dims);

/// Takes LPS millimetres relative to the centre of the volume's box, the frame of a shell's
/// surface, to voxel coordinates. The matrix's translation never enters: a volume far from the
/// origin loses no digits.
/// @pre  the matrix is regular
glm::dmat4 voxel_from_local(const glm::i64vec3& dims, const glm::dmat4& world_from_voxel);

/// A sphere in LPS millimetres.
struct BoundingSphere {
  glm::dvec3 center_mm{0.0};
  double radius_mm = 1.0;  ///< positive
};

/// The sphere around the volume's box: its centre, and half its (longest) diagonal.
BoundingSphere bounding_sphere(const glm::i64vec3& dims, const glm::dmat4& world_from_voxel);

/// Distance between neighbouring samples along x, y, z: the lengths of the matrix's columns, in mm.
glm::dvec3 spacing_mm(const glm::dmat4& world_from_voxel);

/// Largest deviation of the voxel axes from right angles, in radians: 0 for an orthogonal grid.
double shear_rad(const glm::dmat4& world_from_voxel);

/// Volume of the unit cell over the product of its edge lengths, signed: +-1 for an orthogonal
/// grid, 0 for a singular one, negative for a left-handed one.
double handedness(const glm::dmat4& world_from_voxel);

}  // namespace nacre

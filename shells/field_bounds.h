#pragma once

#include "shells/trilinear_field.h"

namespace nacre {

/// An interval of values.
struct ValueBounds {
  double lo;
  double hi;
};

/// Bounds of the trilinear field over a triangle: not samples, every point's value lies between
/// them (but for rounding).
///
/// The triangle is cut along the cells' faces. On a piece within one cell the field is a cubic of
/// two parameters; its Bernstein coefficients bound it, and are means of values of the field
/// at points that mix the corners' coordinates (docs/derivations.md, "Bounds of the field over a
/// triangle"). The bounds are off by the second order of the piece's size.
///
/// @param a, b, c  corners in voxel coordinates (`TrilinearField::voxel_from_local`)
ValueBounds value_bounds(const TrilinearField& field, const glm::dvec3& a, const glm::dvec3& b,
                         const glm::dvec3& c);

}  // namespace nacre

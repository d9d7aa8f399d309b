#pragma once

#include <glm/vec3.hpp>

namespace nacre {

/// Solves M x = r for a symmetric positive definite M; 0 where rounding leaves it none.
///
/// @param diagonal  xx, yy, zz
/// @param beside    xy, xz, yz
inline glm::dvec3 solve_symmetric(const glm::dvec3& diagonal, const glm::dvec3& beside,
                                  const glm::dvec3& r) noexcept {
  const double xx = diagonal.x, yy = diagonal.y, zz = diagonal.z;
  const double xy = beside.x, xz = beside.y, yz = beside.z;
  // Cofactors, which are symmetric too.
  const double c_xx = yy * zz - yz * yz;
  const double c_xy = xz * yz - xy * zz;
  const double c_xz = xy * yz - xz * yy;
  const double determinant = xx * c_xx + xy * c_xy + xz * c_xz;
  if (!(determinant > 0.0)) return glm::dvec3(0.0);
  const double c_yy = xx * zz - xz * xz;
  const double c_yz = xy * xz - xx * yz;
  const double c_zz = xx * yy - xy * xy;
  return glm::dvec3(c_xx * r.x + c_xy * r.y + c_xz * r.z, c_xy * r.x + c_yy * r.y + c_yz * r.z,
                    c_xz * r.x + c_yz * r.y + c_zz * r.z) /
         determinant;
}

}  // namespace nacre

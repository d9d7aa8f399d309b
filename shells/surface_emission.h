#pragma once

#include <cstddef>

#include "core/emission.h"
#include "core/triangle_mesh.h"
#include "shells/trilinear_field.h"

namespace nacre {

/// Surfaces are stored in float: a vertex of the border plane is this close to it, in voxels.
inline constexpr double kOnBorderVoxels = 1e-3;

/// The emission on a shell's surface, which would be its level everywhere on an exact contour.
struct SurfaceEmission {
  /// Bounds of the emission over all triangles but those within one border plane of the volume
  /// (caps, where the emission is what it is). lo > hi where there are none.
  double lo = 1.0;
  double hi = 0.0;

  double max_error = 0.0;  ///< largest |phi - t_k| of the samples (as `LevelError`)
  double rms_error = 0.0;  ///< its root mean square over the surface's area
  double area_mm2 = 0.0;   ///< that the samples stand for
  /// Part of the area that is off by more than the tolerance.
  double beyond_tolerance = 0.0;
  /// Largest error of a sample less what moving it by a grid step along each axis can account for:
  /// what a simplification answers for after snapping.
  double max_error_less_snapping = 0.0;

  /// Bound of |phi - t_k| off the border planes: no point of the surface has more.
  double error_bound(double level) const noexcept {
    return lo > hi ? 0.0 : (level - lo > hi - level ? level - lo : hi - level);
  }
};

/// How far within the border plane the vertices on it are after snapping at most, in voxels: half a
/// step along each axis, of a matrix whose axes may be oblique. Most lie beyond (`BorderRounding`).
double border_voxels(const TrilinearField& field, double step_mm) noexcept;

/// Whether a triangle lies within one border plane of the volume, where shells are capped.
/// @param border  see `border_voxels`
bool is_cap(const TrilinearField& field, const glm::dvec3& a_mm, const glm::dvec3& b_mm,
            const glm::dvec3& c_mm, double border) noexcept;

/// Measures a surface against the field.
///
/// Errors are sampled: each triangle is cut evenly until its parts are at most half a voxel long,
/// and sampled at their centres and at its corners. The bounds are bounds (`value_bounds`).
///
/// @param level      t_k
/// @param tolerance  for `beyond_tolerance`
/// @param step_mm    the grid's step; 0 for a surface that was not snapped
/// The same for any number of threads; about a microsecond a triangle.
SurfaceEmission measure_surface_emission(const TriangleMesh& mesh, const TrilinearField& field,
                                         const EmissionMap& emission, double level,
                                         double tolerance = 0.0, double step_mm = 0.0);

/// Its bounds alone: a small part of the work.
SurfaceEmission bound_surface_emission(const TriangleMesh& mesh, const TrilinearField& field,
                                       const EmissionMap& emission, double step_mm = 0.0);

}  // namespace nacre

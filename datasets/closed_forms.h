#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "core/camera.h"

namespace nacre {

/// The closed-form phantoms: fields v(p) over LPS millimetres, centred on the origin, with level
/// surfaces and projections known exactly (docs/derivations.md, "Phantoms"). Lines are infinite.
///
/// The phantoms hold samples of these fields; between samples a volume is trilinear, so that its
/// own level surfaces and projections differ from these by O(spacing^2), except where stated.

/// `spheres`: v = max(0, radius - |p|). Nested spheres.
struct SphereField {
  double radius_mm = 28.0;

  double value(const glm::dvec3& p_mm) const;

  /// Radius of the level surface { v = level }.
  /// @param level  in (0, radius_mm)
  double level_radius_mm(double level) const;

  /// Largest value along a line: max(0, R - d), d the line's distance from the origin.
  double maximum(const Ray& line) const;

  /// Integral of v along a line, in value * mm: R h - d^2 asinh(h / d), h = sqrt(R^2 - d^2).
  double integral(const Ray& line) const;

  /// Length of a line inside { v >= level }, mm.
  /// @param level  in (0, radius_mm)
  double chord_mm(const Ray& line, double level) const;
};

/// `torus`: v = r - sqrt((sqrt(x^2 + y^2) - R)^2 + z^2), the signed distance to a torus about the z
/// axis, positive inside. Its level surfaces are the tori of tube radius r - level.
struct TorusField {
  double major_radius_mm = 18.0;  ///< R, of the tube's centre line
  double minor_radius_mm = 8.0;   ///< r, of the tube at level 0

  double value(const glm::dvec3& p_mm) const;

  /// Area of the level surface: 4 pi^2 R (r - level), mm^2.
  /// @param level  with 0 < r - level < R: a ring
  double level_area_mm2(double level) const;

  /// Volume inside the level surface: 2 pi^2 R (r - level)^2, mm^3.
  /// @param level  with 0 < r - level < R
  double level_volume_mm3(double level) const;

  /// Largest value along the line parallel to the z axis through (x, y): r - |sqrt(x^2 + y^2) - R|.
  double maximum_along_z(double x_mm, double y_mm) const;

  /// Largest value along a line parallel to the x (or, by symmetry, the y) axis: r - |z| where it
  /// passes over the ring's centre line, |y| <= R; else r - sqrt((|y| - R)^2 + z^2).
  double maximum_along_x(double y_mm, double z_mm) const;
};

/// `quadratic`: v = offset + a x^2 + b y^2 + c z^2, with a, b, c < 0: nested ellipsoids.
struct QuadraticField {
  double offset = 1000.0;
  glm::dvec3 curvature{-1.0, -1.5, -2.25};  ///< a, b, c, in value / mm^2

  double value(const glm::dvec3& p_mm) const;

  /// Semi-axes of the level surface: sqrt((level - offset) / a), ...
  /// @param level  below offset
  glm::dvec3 level_semi_axes_mm(double level) const;

  /// Largest value along a line (the quadratic in t has its vertex there).
  double maximum(const Ray& line) const;

  /// Integral of v along the part t_enter to t_leave of a line, in value * mm.
  double integral(const Ray& line, double t_enter_mm, double t_leave_mm) const;

  /// What the trilinear field between samples of v has there, exactly: with f_i the fraction of the
  /// way between its neighbouring samples along axis i, and h_i their spacing,
  /// v(p) + sum_i a_i h_i^2 f_i (1 - f_i).
  double trilinear_value(const glm::dvec3& p_mm, const glm::dvec3& spacing_mm,
                         const glm::dvec3& fraction) const;
};

/// `cell`: the trilinear function with the given values at a unit cube's corners (x fastest).
struct CellField {
  std::array<double, 8> corners;

  /// @param p  in [0, 1]^3
  double value(const glm::dvec3& p) const;

  /// Along a line through the cell the field is a cubic in t:
  /// v(origin + t * direction) = c[0] + c[1] t + c[2] t^2 + c[3] t^3.
  std::array<double, 4> cubic_along(const glm::dvec3& origin, const glm::dvec3& direction) const;
};

/// `checkerboard`: 0 and 1 in turn, (x + y + z) mod 2 at sample (x, y, z). Every cell is the same
/// ambiguous one, up to sign.
struct CheckerboardField {
  /// The trilinear field in voxel coordinates, exactly: 1/2 - 1/2 T(x) T(y) T(z), with the
  /// triangle wave T(x) = (-1)^floor(x) (1 - 2 (x - floor(x))). Its level surface at 1/2 is the
  /// planes midway between samples.
  double value(const glm::dvec3& p_voxel) const;
};

}  // namespace nacre

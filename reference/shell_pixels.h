#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "core/camera.h"
#include "core/image.h"
#include "core/picture.h"
#include "reference/tool_rays.h"
#include "reference/triangle_crossing.h"

namespace nacre {

/// The ray through a pixel's centre, and what has been seen along it so far.
struct ShellPixel {
  explicit ShellPixel(const Ray& ray) : along(ray), direction(ray.direction) {}

  RayCoordinates along;
  glm::dvec3 direction;
  RayInterval interval;         ///< what shows: of the slab, before the tool; may be empty
  double beta_at_origin = 1.0;  ///< the cue, linear in t
  double beta_per_mm = 0.0;
  /// From where on crossings are counted, to know how many shells are around that point; NaN: not.
  double counted_from_mm = std::numeric_limits<double>::quiet_NaN();
  double zero_mm = 0.0;  ///< where the antiderivative of beta is 0
  double value = 0.0;    ///< of the picture
  int around = 0;        ///< shells around the point at `counted_from_mm`

  bool is_empty() const { return !(interval.t_begin_mm < interval.t_end_mm); }
  bool shows(double t) const { return t >= interval.t_begin_mm && t <= interval.t_end_mm; }
  double beta(double t) const { return beta_at_origin + beta_per_mm * t; }

  /// B(t), the integral of beta from `zero_mm` to t, mm.
  double beta_integral(double t) const { return (t - zero_mm) * (0.5 * (beta(zero_mm) + beta(t))); }
};

/// An axis-parallel box, LPS mm; empty if lo > hi.
struct ShellBounds {
  glm::dvec3 lo_mm{std::numeric_limits<double>::infinity()};
  glm::dvec3 hi_mm{-std::numeric_limits<double>::infinity()};
};

/// Sets up the pixels of some rows, and draws the tools they see.
///
/// @param bounds  of the shells shown: where none can be around a point, none are counted
/// @param layer   of the camera's size; null without tools
std::vector<ShellPixel> make_shell_pixels(const Camera& camera, const DepthCue& cue,
                                          const Slab& slab, const ShellBounds& bounds,
                                          const ToolRays* tools, ToolLayer* layer, int first_row,
                                          int end_row);

}  // namespace nacre

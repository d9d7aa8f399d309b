#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "core/camera.h"
#include "core/picture.h"
#include "render/projection.h"

namespace nacre {

/// Where the rays of a picture start and end, as view depths (see `projection.h`), before tools.
struct RaySpan {
  double start_mm = 0.0;
  double end_mm = std::numeric_limits<double>::infinity();
};

/// What a fragment needs to know of its ray, as affine functions whose values are small where the
/// picture is: depth is counted from the start of the rays, so that floats keep the digits.
///
/// With d the depth beyond the start, along the viewing direction:
///
///     d    = dot(depth_from_local, (p, 1))         p relative to the set's centre, mm
///     z    = z_of_depth.x + z_of_depth.y d         the design's depth z
///     beta = cue.x + cue.y d                       between cue_range.x and .y for z in [0, 1]
///     way  = (slope_of_pixel.xy + slope_of_pixel.zw * pixel, 1)
///
/// `way` is the ray's direction to the right, upwards and forward; a mm of d is |way| mm of the ray
/// (1 without perspective). The antiderivative of beta along the ray, 0 at its start, is
///
///     B(d) = |way| d (cue.x + cue.y d / 2).
///
/// docs/derivations.md, section 3.
struct RayFrame {
  glm::dvec4 depth_from_local{0.0};
  double end_mm = 0.0;  ///< d where the slab ends; infinite where nothing does
  glm::dvec2 z_of_depth{0.0};
  glm::dvec2 cue{1.0, 0.0};
  glm::dvec2 cue_range{1.0, 1.0};
  glm::dvec4 slope_of_pixel{0.0};   ///< pixels counted from the corner of the rectangle drawn
  glm::dmat3 local_from_view{1.0};  ///< columns right, up, forward
};

/// @param origin_mm  what local positions are relative to
/// @param rect       the part of the picture that is drawn
RayFrame ray_frame(const Camera& camera, const glm::dvec3& origin_mm, const RaySpan& rays,
                   const DepthCue& cue, const PixelRect& rect);

/// beta where a ray is that deep beyond its start.
double cue_at_depth(const RayFrame& rays, double depth_mm) noexcept;

/// The way of a pixel's ray in the frame of local positions, 1 forward.
///
/// @param pixel  its centre, from the corner of the rectangle drawn: (0.5, 0.5) for the first
glm::dvec3 local_way(const RayFrame& rays, const glm::dvec2& pixel) noexcept;

/// Depth z at a view depth: 1 at the sphere's nearest point, 0 at its farthest.
double z_at_view_depth(const Camera& camera, double view_depth_mm);

}  // namespace nacre

#include "render/ray_frame.h"

#include <algorithm>

namespace nacre {
namespace {

/// Slope of the rays per pixel of a rectangle: to the right and up, per unit forward.
glm::dvec4 slope_of_pixel(const Camera& camera, const PixelRect& rect) {
  if (!camera.perspective) return glm::dvec4(0.0);
  const glm::dvec2 corner = camera.half_extent * picture_offset(camera, rect.x, rect.y);
  const double per_pixel = 2.0 * camera.half_extent / std::min(camera.size.x, camera.size.y);
  return {corner.x, corner.y, per_pixel, -per_pixel};
}

}  // namespace

double z_at_view_depth(const Camera& camera, double view_depth_mm) {
  const double radius = camera.sphere.radius_mm;
  const double center_mm = view_depth_of_slab(camera, 0.0);
  return (radius + center_mm - view_depth_mm) / (2.0 * radius);
}

RayFrame ray_frame(const Camera& camera, const glm::dvec3& origin_mm, const RaySpan& rays,
                   const DepthCue& cue, const PixelRect& rect) {
  RayFrame frame;
  frame.depth_from_local = view_depth_from_local(camera, origin_mm);
  frame.depth_from_local.w -= rays.start_mm;
  frame.end_mm = rays.end_mm - rays.start_mm;
  const double z_per_mm = -0.5 / camera.sphere.radius_mm;
  frame.z_of_depth = {z_at_view_depth(camera, rays.start_mm), z_per_mm};
  frame.cue = {beta(cue, frame.z_of_depth.x), cue.a * z_per_mm};
  const auto [lo, hi] = std::minmax({beta(cue, 0.0), beta(cue, 1.0)});
  frame.cue_range = {lo, hi};
  frame.slope_of_pixel = slope_of_pixel(camera, rect);
  frame.local_from_view = glm::dmat3(camera.right, camera.up, camera.forward);
  return frame;
}

double cue_at_depth(const RayFrame& rays, double depth_mm) noexcept {
  return std::clamp(rays.cue.x + rays.cue.y * depth_mm, rays.cue_range.x, rays.cue_range.y);
}

glm::dvec3 local_way(const RayFrame& rays, const glm::dvec2& pixel) noexcept {
  const glm::dvec4& slope = rays.slope_of_pixel;
  return rays.local_from_view *
         glm::dvec3(slope.x + slope.z * pixel.x, slope.y + slope.w * pixel.y, 1.0);
}

}  // namespace nacre

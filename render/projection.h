#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/camera.h"
#include "render/scene_facts.h"

namespace nacre {

/// A rectangle of a picture, in pixels from its upper left corner.
struct PixelRect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// Eye depth of the near plane, mm: what lies nearer to a perspective eye, or behind it, is not
/// drawn. A hundred thousandth of the sphere's radius, so that only rounding is cut away.
double near_plane_mm(const Camera& camera);

/// Clip coordinates of a point given in mm relative to `origin_mm`, for a target that holds the
/// rectangle `rect` of the picture.
///
/// x to the right and **y downwards**: the first row of the target is the top row of the picture,
/// so that what is read back needs no turning (front faces are clockwise there). A pixel's centre
/// in the target is the pixel's centre in `picture_ray`.
///
/// z before the remap is real depth. Orthographic: -1 at the sphere's nearest and 1 at its farthest
/// point, 1 - 2 * depth_z, not to be clipped (the eye is infinitely far). Perspective: w - 2 near,
/// so that -1 is the near plane and there is no far plane. Emission is put in place of it after the
/// division, by the depth range ([H96] eqs 3 and 5; see `ShellDraw`), so x, y, w and near-plane
/// clipping stay what they are.
///
/// Built in double; positions are floats relative to the set's centre, so the matrix that takes
/// them can be rounded to float without harm.
glm::dmat4 clip_from_local(const Camera& camera, const glm::dvec3& origin_mm,
                           const PixelRect& rect);

/// Whether no ray of the picture meets the box (relative to `origin_mm`), found by the picture's
/// side planes, widened by a pixel, and the near plane. May say no where the answer is yes, never
/// the reverse.
bool outside_view(const Camera& camera, const glm::dvec3& origin_mm, const Box& box);

/// Whether all of the box lies beyond the near plane; always so for an orthographic camera. Then
/// the eye is outside whatever the box bounds.
bool beyond_near_plane(const Camera& camera, const glm::dvec3& origin_mm, const Box& box);

}  // namespace nacre

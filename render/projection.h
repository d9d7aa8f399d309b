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

/// **View depth**: how far along the viewing direction a point lies, mm. Perspective: from the eye
/// (eye depth). Orthographic, where the eye is infinitely far: from the sphere's centre, as slabs
/// are given. The affine function of a point relative to `origin_mm`: dot(row.xyz, p) + row.w.
glm::dvec4 view_depth_from_local(const Camera& camera, const glm::dvec3& origin_mm);

/// View depth of what is `slab_mm` along the viewing direction from the sphere's centre.
double view_depth_of_slab(const Camera& camera, double slab_mm);

/// Values from `lo` to `hi`.
struct Interval {
  double lo = 0.0;
  double hi = 0.0;
};

/// View depths, mm, of a box that is not empty (relative to `origin_mm`).
Interval view_depths(const Camera& camera, const glm::dvec3& origin_mm, const Box& box);

/// Whether something in the box `front` may hide, from some ray of the picture, something in the
/// box `behind`: they overlap in the picture, to a pixel, and the one does not lie wholly farther
/// away. May say yes where the answer is no, never the reverse.
bool may_hide(const Camera& camera, const glm::dvec3& origin_mm, const Box& front,
              const Box& behind);

}  // namespace nacre

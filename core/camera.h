#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

#include "core/volume_geometry.h"

namespace nacre {

/// Views of the patient, in the LPS frame (+x left, +y posterior, +z superior).
///
/// | view | camera stands at | up |
/// |---|---|---|
/// | anterior / posterior | -y / +y | +z |
/// | left / right | +x / -x | +z |
/// | superior / inferior | +z / -z | -y |
///
/// `inferior` is the radiological axial view: the patient's left is on the right of the picture.
enum class NamedView { Anterior, Posterior, Left, Right, Superior, Inferior };

std::string_view name(NamedView view) noexcept;

/// The view of that name ("anterior", ...), if there is one.
std::optional<NamedView> named_view(std::string_view name) noexcept;

/// How a picture is taken: what `--size`, `--view`, `--azimuth` and the like say.
struct CameraOptions {
  glm::ivec2 size{512, 512};  ///< pixels, width and height, each from 1 to 32768
  NamedView view = NamedView::Anterior;
  double azimuth_rad = 0.0;    ///< about the view's up, as `vtkCamera::Azimuth`: to its right
  double elevation_rad = 0.0;  ///< then upwards, as `vtkCamera::Elevation`
  double roll_rad = 0.0;       ///< then about the viewing direction, as `vtkCamera::Roll`
  double zoom = 1.0;           ///< positive; narrows the picture, the eye stays
  std::optional<double> field_of_view_rad =
      std::nullopt;  ///< perspective over the shorter side, in (0, pi)
  std::optional<double> distance_mm =
      std::nullopt;  ///< of the eye from the target; perspective only
  std::optional<glm::dvec3> look_at_mm =
      std::nullopt;  ///< target, LPS mm; default: the sphere's centre
};

/// A ray in LPS millimetres: origin + t * direction, t in mm.
struct Ray {
  glm::dvec3 origin_mm;
  glm::dvec3 direction;  ///< of unit length
};

/// A camera in the patient frame; the one implementation for all renderers.
///
/// `right`, `up`, `forward` are orthonormal, with right = forward x up. Pixel (i, j) has its centre
/// at (i + 1/2, j + 1/2), row 0 at the top of the picture.
struct Camera {
  glm::ivec2 size{512, 512};
  glm::dvec3 target_mm{0.0};
  glm::dvec3 right{1.0, 0.0, 0.0};
  glm::dvec3 up{0.0, 0.0, 1.0};
  glm::dvec3 forward{0.0, 1.0, 0.0};
  bool perspective = false;
  double eye_distance_mm = 0.0;  ///< of the eye before the target; perspective only
  /// Half the picture's shorter side: in mm (orthographic), or as the tangent of its half angle
  /// (perspective).
  double half_extent = 1.0;
  /// Around the volume: depth, slabs and the default target are measured from it.
  BoundingSphere sphere;
};

/// The camera of the design: orthographic on the sphere's centre with half the shorter side equal
/// to R / zoom; in perspective the eye stands at R / sin(FOV / 2) before the target, the picture's
/// half angle has the tangent tan(FOV / 2) / zoom.
///
/// Azimuth, elevation and roll follow vtkCamera: azimuth and elevation move the eye about the
/// target and keep the view's up vector, which is then made orthogonal to the viewing direction;
/// exactly over the pole, where VTK's camera is undefined, the limit from below is taken.
///
/// @throws Error  BadArgument for a size, zoom, field of view, distance or angle out of range
Camera make_camera(const CameraOptions& options, const BoundingSphere& sphere);

/// The same view in `per_pixel` by `per_pixel` rays a pixel, as pixels of a larger picture. Where
/// that is odd, the middle one of each goes through the pixel's centre.
Camera with_samples(Camera camera, int per_pixel);

/// Position of the eye, LPS mm.
/// @pre camera.perspective
glm::dvec3 eye_mm(const Camera& camera);

/// Offset of a point of the picture from its centre, in units of half the shorter side: x to the
/// right, y up. Pixel (i, j)'s centre is `pixel_x = i + 0.5`, `pixel_y = j + 0.5`.
glm::dvec2 picture_offset(const Camera& camera, double pixel_x, double pixel_y);

/// The ray through a point of the picture, given in pixels from its upper left corner.
///
/// Orthographic: the origin lies in the plane through the sphere's centre, and the ray is a line
/// (t from minus infinity). Perspective: it starts at the eye, t = 0.
Ray picture_ray(const Camera& camera, double pixel_x, double pixel_y);

/// Depth of a point along the viewing direction from the sphere's centre, mm, positive away from
/// the eye: what slabs are given in.
double slab_depth_mm(const Camera& camera, const glm::dvec3& p_mm);

/// The design's depth z of a point: 1 at the sphere's nearest point, 0 at its farthest, linear
/// along the viewing direction (in perspective: eye depth). Outside [0, 1] for points outside the
/// sphere.
double depth_z(const Camera& camera, const glm::dvec3& p_mm);

}  // namespace nacre

#include "core/camera.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/error.h"

namespace nacre {
namespace {

constexpr int kMaxPictureSide = 32768;

/// Below this sine of the angle between view direction and up vector, up says nothing.
constexpr double kPole = 1e-9;

struct NamedViewFrame {
  NamedView view;
  std::string_view name;
  glm::dvec3 forward;
  glm::dvec3 up;
};

const std::array<NamedViewFrame, 6> kNamedViews{{
    {NamedView::Anterior, "anterior", {0, 1, 0}, {0, 0, 1}},
    {NamedView::Posterior, "posterior", {0, -1, 0}, {0, 0, 1}},
    {NamedView::Left, "left", {-1, 0, 0}, {0, 0, 1}},
    {NamedView::Right, "right", {1, 0, 0}, {0, 0, 1}},
    {NamedView::Superior, "superior", {0, 0, -1}, {0, -1, 0}},
    {NamedView::Inferior, "inferior", {0, 0, 1}, {0, -1, 0}},
}};

const NamedViewFrame& frame_of(NamedView view) {
  return *std::find_if(kNamedViews.begin(), kNamedViews.end(),
                       [view](const NamedViewFrame& frame) { return frame.view == view; });
}

/// Sine and cosine that are exact at multiples of a right angle, so that a view turned by 90
/// degrees is the named view itself.
glm::dvec2 cos_sin(double angle_rad) {
  const double quarters = angle_rad / (0.5 * std::numbers::pi);
  const double nearest = std::round(quarters);
  if (std::abs(quarters - nearest) > 1e-14 * std::max(1.0, std::abs(quarters))) {
    return {std::cos(angle_rad), std::sin(angle_rad)};
  }
  constexpr std::array<glm::dvec2, 4> quarters_cos_sin{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  const auto turns = static_cast<int>(std::fmod(nearest, 4.0));
  return quarters_cos_sin[static_cast<std::size_t>((turns + 4) % 4)];
}

/// Right-handed rotation of v about a unit axis (Rodrigues).
glm::dvec3 rotate(const glm::dvec3& v, const glm::dvec3& axis, double angle_rad) {
  const glm::dvec2 cs = cos_sin(angle_rad);
  return cs.x * v + cs.y * glm::cross(axis, v) + (1.0 - cs.x) * glm::dot(axis, v) * axis;
}

void require(bool holds, std::string_view subject, double found, std::string_view expected) {
  if (!holds) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: found {}, expected {}", subject, found, expected));
  }
}

void check(const CameraOptions& options) {
  for (const int side : {options.size.x, options.size.y}) {
    require(side >= 1 && side <= kMaxPictureSide, "picture size", side, "1 to 32768 pixels");
  }
  for (const double angle : {options.azimuth_rad, options.elevation_rad, options.roll_rad}) {
    require(std::isfinite(angle), "view angle", angle, "a finite number");
  }
  require(std::isfinite(options.zoom) && options.zoom > 0.0, "zoom", options.zoom,
          "a positive number");
  if (options.field_of_view_rad) {
    const double fov = *options.field_of_view_rad;
    require(fov > 0.0 && fov < std::numbers::pi, "field of view in degrees",
            fov * 180.0 / std::numbers::pi, "above 0 and below 180");
  }
  if (options.distance_mm) {
    require(options.field_of_view_rad.has_value(), "camera distance", *options.distance_mm,
            "a perspective camera with it (an orthographic eye is infinitely far)");
    require(std::isfinite(*options.distance_mm) && *options.distance_mm >= 0.0, "camera distance",
            *options.distance_mm, "0 mm or more");
  }
  if (options.look_at_mm) {
    for (int axis = 0; axis < 3; ++axis) {
      require(std::isfinite((*options.look_at_mm)[axis]), "look-at", (*options.look_at_mm)[axis],
              "finite coordinates in mm");
    }
  }
}

}  // namespace

std::string_view name(NamedView view) noexcept { return frame_of(view).name; }

std::optional<NamedView> named_view(std::string_view name) noexcept {
  for (const NamedViewFrame& frame : kNamedViews) {
    if (frame.name == name) return frame.view;
  }
  return std::nullopt;
}

Camera make_camera(const CameraOptions& options, const BoundingSphere& sphere) {
  check(options);
  const NamedViewFrame& frame = frame_of(options.view);

  // Azimuth about the view's up, elevation about the turned camera's left, as vtkCamera.
  glm::dvec3 forward = rotate(frame.forward, frame.up, options.azimuth_rad);
  const glm::dvec3 level_right = glm::normalize(glm::cross(forward, frame.up));
  forward = glm::normalize(rotate(forward, -level_right, options.elevation_rad));

  glm::dvec3 right = glm::cross(forward, frame.up);
  right = glm::length(right) < kPole ? level_right : glm::normalize(right);
  const glm::dvec3 up = glm::cross(right, forward);

  Camera camera;
  camera.size = options.size;
  camera.target_mm = options.look_at_mm.value_or(sphere.center_mm);
  camera.forward = forward;
  camera.up = glm::normalize(rotate(up, forward, options.roll_rad));
  camera.right = glm::normalize(glm::cross(forward, camera.up));
  camera.sphere = sphere;
  if (options.field_of_view_rad) {
    const double half_angle = 0.5 * *options.field_of_view_rad;
    camera.perspective = true;
    camera.eye_distance_mm = options.distance_mm.value_or(sphere.radius_mm / std::sin(half_angle));
    camera.half_extent = std::tan(half_angle) / options.zoom;
  } else {
    camera.half_extent = sphere.radius_mm / options.zoom;
  }
  return camera;
}

Camera with_samples(Camera camera, int per_pixel) {
  camera.size *= per_pixel;
  return camera;
}

glm::dvec3 eye_mm(const Camera& camera) {
  return camera.target_mm - camera.eye_distance_mm * camera.forward;
}

glm::dvec2 picture_offset(const Camera& camera, double pixel_x, double pixel_y) {
  const double shorter = std::min(camera.size.x, camera.size.y);
  return {(2.0 * pixel_x - camera.size.x) / shorter, (camera.size.y - 2.0 * pixel_y) / shorter};
}

Ray picture_ray(const Camera& camera, double pixel_x, double pixel_y) {
  const glm::dvec2 offset = camera.half_extent * picture_offset(camera, pixel_x, pixel_y);
  const glm::dvec3 sideways = offset.x * camera.right + offset.y * camera.up;
  if (camera.perspective) {
    return {eye_mm(camera), glm::normalize(camera.forward + sideways)};
  }
  const double to_center = slab_depth_mm(camera, camera.target_mm);
  return {camera.target_mm - to_center * camera.forward + sideways, camera.forward};
}

double slab_depth_mm(const Camera& camera, const glm::dvec3& p_mm) {
  return glm::dot(p_mm - camera.sphere.center_mm, camera.forward);
}

double depth_z(const Camera& camera, const glm::dvec3& p_mm) {
  const double radius = camera.sphere.radius_mm;
  return (radius - slab_depth_mm(camera, p_mm)) / (2.0 * radius);
}

}  // namespace nacre

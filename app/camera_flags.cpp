#include "app/camera_flags.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <numbers>

#include "app/flag_values.h"
#include "core/error.h"

namespace nacre {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

glm::ivec2 parse_size(const std::string& flag, const std::string& text) {
  const auto parts = split(text, 'x');
  if (parts.size() == 2) {
    const auto side = [&](const std::string& part) {
      return parse_integers(flag, part, 1, "WxH in pixels").front();
    };
    const long long width = side(parts[0]);
    const long long height = side(parts[1]);
    if (width >= 1 && height >= 1 && width <= 32768 && height <= 32768) {
      return {static_cast<int>(width), static_cast<int>(height)};
    }
  }
  throw Error(ErrorCode::BadArgument,
              fmt::format("{}: found '{}', expected WxH, each from 1 to 32768 pixels", flag, text));
}

void add_camera_flags(CLI::App& verb, CameraFlags& flags) {
  const std::string group = "Camera";
  verb.add_option("--size", flags.size, "WxH of the picture in pixels")
      ->capture_default_str()
      ->group(group);
  verb.add_option("--view", flags.view, "anterior, posterior, left, right, superior or inferior")
      ->capture_default_str()
      ->group(group);
  verb.add_option("--azimuth", flags.azimuth_deg, "DEG the camera moves to its right")
      ->group(group);
  verb.add_option("--elevation", flags.elevation_deg, "DEG it then moves up")->group(group);
  verb.add_option("--roll", flags.roll_deg, "DEG it then turns about the viewing direction")
      ->group(group);
  verb.add_option("--zoom", flags.zoom, "Magnification")->capture_default_str()->group(group);
  verb.add_option("--perspective", flags.perspective_deg,
                  "Field of view in DEG over the shorter side (default: orthographic)")
      ->group(group)
      ->each([&flags](const std::string&) { flags.has_perspective = true; });
  verb.add_option("--distance", flags.distance_mm, "MM from the eye to the target (perspective)")
      ->group(group)
      ->each([&flags](const std::string&) { flags.has_distance = true; });
  verb.add_option("--look-at", flags.look_at, "X,Y,Z of the target, LPS mm (default: the centre)")
      ->group(group);
  verb.add_option("--slab", flags.slab,
                  "NEAR,FAR: show only this part, mm from the centre, positive away from the eye")
      ->group(group);
  verb.add_option("--turntable", flags.turntable,
                  "N views about the up axis; the output's name holds %03d, or is absent (timing)")
      ->check(CLI::Range(1, 100000))
      ->group(group);
}

CameraOptions camera_options(const CameraFlags& flags) {
  CameraOptions options;
  options.size = parse_size("--size", flags.size);
  const auto view = named_view(flags.view);
  if (!view) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("--view: found '{}', expected anterior, posterior, left, right, "
                            "superior or inferior",
                            flags.view));
  }
  options.view = *view;
  options.azimuth_rad = flags.azimuth_deg * kDegree;
  options.elevation_rad = flags.elevation_deg * kDegree;
  options.roll_rad = flags.roll_deg * kDegree;
  options.zoom = flags.zoom;
  if (flags.has_perspective) options.field_of_view_rad = flags.perspective_deg * kDegree;
  if (flags.has_distance) options.distance_mm = flags.distance_mm;
  if (!flags.look_at.empty()) {
    const auto p = parse_numbers("--look-at", flags.look_at, 3, "X,Y,Z in LPS mm");
    options.look_at_mm = glm::dvec3(p[0], p[1], p[2]);
  }
  return options;
}

Slab slab(const CameraFlags& flags) {
  if (flags.slab.empty()) return {};
  const auto ends = parse_numbers("--slab", flags.slab, 2, "NEAR,FAR in mm");
  if (!(ends[0] < ends[1])) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("--slab: found '{}', expected NEAR < FAR", flags.slab));
  }
  return {ends[0], ends[1]};
}

}  // namespace nacre

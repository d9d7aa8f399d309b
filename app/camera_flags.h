#pragma once

#include <string>

#include "core/camera.h"
#include "core/picture.h"

namespace CLI {
class App;
}

namespace nacre {

/// The camera, as flags say it: degrees, and texts with commas.
struct CameraFlags {
  std::string size = "512x512";
  std::string view = "anterior";
  double azimuth_deg = 0.0;
  double elevation_deg = 0.0;
  double roll_deg = 0.0;
  double zoom = 1.0;
  double perspective_deg = 0.0;
  double distance_mm = 0.0;
  std::string look_at;
  std::string slab;
  int turntable = 0;             ///< views about the up axis; 0: the one view
  bool has_perspective = false;  ///< else orthographic
  bool has_distance = false;     ///< else the usual one
};

/// "WxH" as a picture's size.
/// @param flag    for the error
/// @throws Error  BadArgument for anything but two numbers from 1 to 32768
glm::ivec2 parse_size(const std::string& flag, const std::string& text);

/// Adds --size, --view, --azimuth, ... and --turntable.
void add_camera_flags(CLI::App& verb, CameraFlags& flags);

/// @throws Error  BadArgument for what the flags cannot mean
CameraOptions camera_options(const CameraFlags& flags);
Slab slab(const CameraFlags& flags);

}  // namespace nacre

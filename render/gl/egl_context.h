#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/gl/gl_context.h"

namespace nacre {

/// A way to open EGL without a window system.
struct EglPlatform {
  enum class Kind { Device, Surfaceless };

  Kind kind = Kind::Surfaceless;
  int device = 0;                ///< number among the devices EGL lists; Device only
  bool software_device = false;  ///< says EGL_MESA_device_software; Device only

  /// "device 0", "surfaceless".
  std::string name() const;
};

/// What libEGL.so.1 (loaded at run time) offers here: its devices, then Mesa's surfaceless
/// platform, which takes a device by itself. Nothing is opened.
///
/// @throws Error  Unsupported if there is no libEGL or it is too old to work without a window
std::vector<EglPlatform> egl_platforms();

/// A core context on that platform, without a surface (or with a surface of one pixel where the
/// driver needs one).
///
/// The display stays open until the process ends: EGL hands the same one to everyone in the
/// process, and closing it would take the others' contexts along.
///
/// @throws Error  Unsupported if the platform does not open or refuses OpenGL 3.3 core
std::unique_ptr<GlContext> open_egl_context(const EglPlatform& platform);

}  // namespace nacre

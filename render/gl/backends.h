#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/gl/gl_context.h"
#include "render/plan.h"

namespace nacre {

/// Which library makes the OpenGL context: `--backend`.
enum class Backend { Auto, Egl, OsMesa };

/// "auto", "egl", "osmesa".
std::string_view name(Backend backend) noexcept;

/// The backend of that name, if there is one.
std::optional<Backend> backend(std::string_view name) noexcept;

/// A context that opens on this machine.
struct BackendInfo {
  Backend backend = Backend::Egl;  ///< Egl or OsMesa
  std::string platform;            ///< "device 0", "surfaceless"; "library" for OSMesa
  std::string renderer;            ///< GL_RENDERER: "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string vendor;              ///< GL_VENDOR
  std::string version;             ///< GL_VERSION: "4.5 (Core Profile) Mesa 22.3.6"
  bool software = false;           ///< drawn by the processor
};

/// What `--list-backends` shows.
struct BackendList {
  std::vector<BackendInfo> working;  ///< in the order in which `Auto` tries them
  std::vector<LeftOut> not_working;  ///< "egl device 1": why
};

/// Opens every context there is, once: takes up to half a second each.
BackendList list_backends();

/// Whether the system has a device that OpenGL might be drawn by: a look at the device files, so
/// that a machine without any is known in no time. Yes where it cannot tell.
bool may_have_hardware();

/// A context and what it is; never null.
struct OpenBackend {
  std::unique_ptr<GlContext> context;
  BackendInfo info;
};

/// Opens the first context that works. EGL: devices with hardware, the surfaceless platform, the
/// software device. Auto: EGL's hardware devices, surfaceless EGL, OSMesa, EGL's software device.
///
/// @throws Error  Unsupported if none works, naming what was tried and why it failed
OpenBackend open_backend(Backend backend);

}  // namespace nacre

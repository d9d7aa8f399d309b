#include "render/gl/backends.h"

#include <GL/glcorearb.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "core/error.h"
#include "render/gl/egl_context.h"
#include "render/gl/gl_functions.h"
#include "render/gl/osmesa_context.h"

namespace nacre {
namespace {

struct NamedBackend {
  Backend backend;
  std::string_view name;
};

constexpr std::array<NamedBackend, 3> kBackends{
    {{Backend::Auto, "auto"}, {Backend::Egl, "egl"}, {Backend::OsMesa, "osmesa"}}};

/// What GL_RENDERER says of the known software renderers.
constexpr std::array<std::string_view, 6> kSoftware{"llvmpipe", "softpipe",    "swrast",
                                                    "Software", "SwiftShader", "SWR"};

/// A context that might open.
struct Candidate {
  Backend backend = Backend::OsMesa;
  EglPlatform platform;  // Egl only

  std::string name() const {
    return backend == Backend::OsMesa ? "osmesa" : "egl " + platform.name();
  }

  std::unique_ptr<GlContext> open() const {
    return backend == Backend::OsMesa ? open_osmesa_context() : open_egl_context(platform);
  }

  /// Place in the order of trying: hardware first, then what needs the least from the machine.
  int rank() const {
    if (backend == Backend::OsMesa) return 2;
    if (platform.kind == EglPlatform::Kind::Surfaceless) return 1;
    return platform.software_device ? 3 : 0;
  }
};

/// What there is of the backend, in the order of trying; reasons for what there is not.
std::vector<Candidate> candidates(Backend wanted, std::vector<LeftOut>& failed) {
  std::vector<Candidate> list;
  if (wanted != Backend::OsMesa) {
    try {
      for (const EglPlatform& platform : egl_platforms()) list.push_back({Backend::Egl, platform});
    } catch (const Error& error) {
      failed.push_back({"egl", error.what()});
    }
  }
  if (wanted != Backend::Egl) list.push_back({Backend::OsMesa, {}});
  std::stable_sort(list.begin(), list.end(),
                   [](const Candidate& a, const Candidate& b) { return a.rank() < b.rank(); });
  return list;
}

std::string text(const GlFunctions& gl, unsigned what) {
  const unsigned char* value = gl.get_string(what);
  return value != nullptr ? reinterpret_cast<const char*>(value) : "";
}

/// Whether GL_RENDERER names one of the known software renderers.
bool is_software(std::string_view renderer) {
  return std::any_of(kSoftware.begin(), kSoftware.end(), [&](std::string_view known) {
    return renderer.find(known) != std::string_view::npos;
  });
}

OpenBackend open(const Candidate& candidate) {
  OpenBackend opened{candidate.open(), {}};
  const CurrentContext current(*opened.context);
  const GlFunctions gl = load_gl_functions(*opened.context);
  opened.info.backend = candidate.backend;
  opened.info.platform =
      candidate.backend == Backend::OsMesa ? "library" : candidate.platform.name();
  opened.info.renderer = text(gl, GL_RENDERER);
  opened.info.vendor = text(gl, GL_VENDOR);
  opened.info.version = text(gl, GL_VERSION);
  opened.info.software = is_software(opened.info.renderer);
  return opened;
}

}  // namespace

std::string_view name(Backend backend) noexcept {
  for (const NamedBackend& entry : kBackends) {
    if (entry.backend == backend) return entry.name;
  }
  return "";
}

std::optional<Backend> backend(std::string_view name) noexcept {
  for (const NamedBackend& entry : kBackends) {
    if (entry.name == name) return entry.backend;
  }
  return std::nullopt;
}

BackendList list_backends() {
  BackendList list;
  for (const Candidate& candidate : candidates(Backend::Auto, list.not_working)) {
    try {
      list.working.push_back(open(candidate).info);
    } catch (const Error& error) {
      list.not_working.push_back({candidate.name(), error.what()});
    }
  }
  return list;
}

bool may_have_hardware() {
  // Direct rendering, NVIDIA's own driver, Windows' under WSL.
  constexpr std::array<const char*, 3> kDevices{"/dev/dri", "/dev/nvidiactl", "/dev/dxg"};
  std::error_code unknown;
  return std::any_of(kDevices.begin(), kDevices.end(), [&](const char* device) {
    return std::filesystem::exists(device, unknown) || unknown;
  });
}

OpenBackend open_backend(Backend backend) {
  std::vector<LeftOut> failed;
  for (const Candidate& candidate : candidates(backend, failed)) {
    try {
      return open(candidate);
    } catch (const Error& error) {
      failed.push_back({candidate.name(), error.what()});
    }
  }
  std::string tried;
  for (const LeftOut& failure : failed) {
    tried += fmt::format("{}{}: {}", tried.empty() ? "" : "; ", failure.what, failure.why);
  }
  throw Error(ErrorCode::Unsupported,
              fmt::format("backend {}: found no OpenGL 3.3 that works without a window ({})",
                          name(backend), tried.empty() ? "EGL offers no platform" : tried));
}

}  // namespace nacre

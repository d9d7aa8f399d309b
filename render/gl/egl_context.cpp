#include "render/gl/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <string_view>

#include "core/error.h"
#include "render/gl/shared_library.h"

namespace nacre {
namespace {

/// Whether a space-separated list holds the word.
bool has_word(const char* list, std::string_view word) {
  if (list == nullptr) return false;
  const std::string_view text(list);
  for (std::size_t at = text.find(word); at != std::string_view::npos;
       at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || text[at - 1] == ' ') && (end == text.size() || text[end] == ' ')) return true;
  }
  return false;
}

/// The functions of libEGL that are needed, those of extensions included.
class Egl {
 public:
  Egl();

  template <class Pointer>
  Pointer function(const char* name) const {
    return reinterpret_cast<Pointer>(get_proc_address(name));
  }

  [[noreturn]] void refuse(std::string_view what) const {
    throw Error(ErrorCode::Unsupported, fmt::format("EGL: {} (error {:#x})", what, get_error()));
  }

 private:
  SharedLibrary library_{"libEGL.so.1"};

 public:
  PFNEGLGETPROCADDRESSPROC get_proc_address =
      library_.require<PFNEGLGETPROCADDRESSPROC>("eglGetProcAddress");
  PFNEGLGETERRORPROC get_error = library_.require<PFNEGLGETERRORPROC>("eglGetError");
  PFNEGLQUERYSTRINGPROC query_string = library_.require<PFNEGLQUERYSTRINGPROC>("eglQueryString");
  PFNEGLINITIALIZEPROC initialize = library_.require<PFNEGLINITIALIZEPROC>("eglInitialize");
  PFNEGLBINDAPIPROC bind_api = library_.require<PFNEGLBINDAPIPROC>("eglBindAPI");
  PFNEGLCHOOSECONFIGPROC choose_config =
      library_.require<PFNEGLCHOOSECONFIGPROC>("eglChooseConfig");
  PFNEGLCREATECONTEXTPROC create_context =
      library_.require<PFNEGLCREATECONTEXTPROC>("eglCreateContext");
  PFNEGLDESTROYCONTEXTPROC destroy_context =
      library_.require<PFNEGLDESTROYCONTEXTPROC>("eglDestroyContext");
  PFNEGLCREATEPBUFFERSURFACEPROC create_pbuffer =
      library_.require<PFNEGLCREATEPBUFFERSURFACEPROC>("eglCreatePbufferSurface");
  PFNEGLDESTROYSURFACEPROC destroy_surface =
      library_.require<PFNEGLDESTROYSURFACEPROC>("eglDestroySurface");
  PFNEGLMAKECURRENTPROC make_current = library_.require<PFNEGLMAKECURRENTPROC>("eglMakeCurrent");
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = nullptr;
  const char* client_extensions = nullptr;
};

Egl::Egl() {
  client_extensions = query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  get_platform_display = function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (!has_word(client_extensions, "EGL_EXT_platform_base") || get_platform_display == nullptr) {
    throw Error(ErrorCode::Unsupported,
                "EGL: found no EGL_EXT_platform_base, expected it for drawing without a window");
  }
}

std::vector<EGLDeviceEXT> devices(const Egl& egl) {
  const bool can_list = has_word(egl.client_extensions, "EGL_EXT_device_enumeration") ||
                        has_word(egl.client_extensions, "EGL_EXT_device_base");
  const auto query = egl.function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  if (!can_list || query == nullptr) return {};
  EGLint count = 0;
  if (query(0, nullptr, &count) != EGL_TRUE || count <= 0) return {};
  std::vector<EGLDeviceEXT> list(static_cast<std::size_t>(count));
  if (query(count, list.data(), &count) != EGL_TRUE) return {};
  list.resize(static_cast<std::size_t>(count));
  return list;
}

EGLDisplay platform_display(const Egl& egl, const EglPlatform& platform) {
  if (platform.kind == EglPlatform::Kind::Surfaceless) {
    return egl.get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  }
  const std::vector<EGLDeviceEXT> list = devices(egl);
  const auto index = static_cast<std::size_t>(platform.device);
  if (index >= list.size()) egl.refuse(fmt::format("found no {}", platform.name()));
  return egl.get_platform_display(EGL_PLATFORM_DEVICE_EXT, list[index], nullptr);
}

/// Any configuration that draws OpenGL; pictures have their own targets. Preferably one with a
/// surface of pixels for drivers that want one.
EGLConfig choose_config(const Egl& egl, EGLDisplay display, bool with_surface) {
  const EGLint surface_type = with_surface ? EGL_PBUFFER_BIT : EGL_DONT_CARE;
  const std::array<EGLint, 5> attributes{EGL_SURFACE_TYPE, surface_type, EGL_RENDERABLE_TYPE,
                                         EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (egl.choose_config(display, attributes.data(), &config, 1, &count) != EGL_TRUE || count < 1) {
    egl.refuse("found no configuration that draws OpenGL");
  }
  return config;
}

class EglContext final : public GlContext {
 public:
  explicit EglContext(const EglPlatform& platform) {
    open_display(platform);
    const bool surfaceless =
        has_word(egl_.query_string(display_, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context");
    const EGLConfig config = choose_config(egl_, display_, !surfaceless);
    create_context(config);
    if (!surfaceless) create_surface(config);
  }

  ~EglContext() override {
    if (surface_ != EGL_NO_SURFACE) egl_.destroy_surface(display_, surface_);
    egl_.destroy_context(display_, context_);
  }

  void make_current() override {
    // Releasing goes by the thread's bound API, which is OpenGL ES on a new thread.
    if (egl_.bind_api(EGL_OPENGL_API) != EGL_TRUE) egl_.refuse("found no OpenGL behind it");
    if (egl_.make_current(display_, surface_, surface_, context_) != EGL_TRUE) {
      egl_.refuse("refused to make its context current");
    }
  }

  void release() noexcept override {
    egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

  EntryPoint entry_point(const char* name) const override { return egl_.get_proc_address(name); }

 private:
  void open_display(const EglPlatform& platform) {
    display_ = platform_display(egl_, platform);
    if (display_ == EGL_NO_DISPLAY) egl_.refuse(platform.name() + ": found no display");
    if (egl_.initialize(display_, nullptr, nullptr) != EGL_TRUE) {
      egl_.refuse(platform.name() + ": its display does not open");
    }
    if (egl_.bind_api(EGL_OPENGL_API) != EGL_TRUE) egl_.refuse("found no OpenGL behind it");
  }

  void create_context(EGLConfig config) {
    const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                           3,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           3,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_NONE};
    context_ = egl_.create_context(display_, config, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT) egl_.refuse("refused a context of OpenGL 3.3 core");
  }

  void create_surface(EGLConfig config) {
    const std::array<EGLint, 5> attributes{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    surface_ = egl_.create_pbuffer(display_, config, attributes.data());
    if (surface_ == EGL_NO_SURFACE) {
      egl_.destroy_context(display_, context_);
      egl_.refuse("refused a surface of one pixel");
    }
  }

  Egl egl_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  EGLSurface surface_ = EGL_NO_SURFACE;
};

}  // namespace

std::string EglPlatform::name() const {
  return kind == Kind::Surfaceless ? "surfaceless" : fmt::format("device {}", device);
}

std::vector<EglPlatform> egl_platforms() {
  const Egl egl;
  std::vector<EglPlatform> platforms;
  if (has_word(egl.client_extensions, "EGL_EXT_platform_device")) {
    const auto query_device =
        egl.function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    const std::vector<EGLDeviceEXT> list = devices(egl);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const char* extensions =
          query_device != nullptr ? query_device(list[i], EGL_EXTENSIONS) : nullptr;
      platforms.push_back({EglPlatform::Kind::Device, static_cast<int>(i),
                           has_word(extensions, "EGL_MESA_device_software")});
    }
  }
  if (has_word(egl.client_extensions, "EGL_MESA_platform_surfaceless")) {
    platforms.push_back({EglPlatform::Kind::Surfaceless, 0, false});
  }
  return platforms;
}

std::unique_ptr<GlContext> open_egl_context(const EglPlatform& platform) {
  return std::make_unique<EglContext>(platform);
}

}  // namespace nacre

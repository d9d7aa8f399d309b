#include "render/gl/osmesa_context.h"

#include <array>
#include <cstdint>

#include "core/error.h"
#include "render/gl/shared_library.h"

namespace nacre {
namespace {

// From Mesa's GL/osmesa.h, which is no longer shipped either.
constexpr int kFormat = 0x22;
constexpr int kProfile = 0x33;
constexpr int kCoreProfile = 0x34;
constexpr int kContextMajorVersion = 0x36;
constexpr int kContextMinorVersion = 0x37;
constexpr int kRgba = 0x1908;               // GL_RGBA
constexpr unsigned kUnsignedByte = 0x1401;  // GL_UNSIGNED_BYTE

struct OpaqueContext;
using OsMesaContextHandle = OpaqueContext*;

/// The functions of libOSMesa that are needed.
struct OsMesaFunctions {
  explicit OsMesaFunctions(const SharedLibrary& library)
      : create(library.require<decltype(create)>("OSMesaCreateContextAttribs")),
        destroy(library.require<decltype(destroy)>("OSMesaDestroyContext")),
        make_current(library.require<decltype(make_current)>("OSMesaMakeCurrent")),
        entry_point(library.require<decltype(entry_point)>("OSMesaGetProcAddress")) {}

  OsMesaContextHandle (*create)(const int* attributes, OsMesaContextHandle share);
  void (*destroy)(OsMesaContextHandle context);
  unsigned char (*make_current)(OsMesaContextHandle context, void* pixels, unsigned type, int width,
                                int height);
  GlContext::EntryPoint (*entry_point)(const char* name);
};

class OsMesaContext final : public GlContext {
 public:
  OsMesaContext() : library_({"libOSMesa.so.8", "libOSMesa.so.6"}), osmesa_(library_) {
    const std::array<int, 10> attributes{
        kFormat, kRgba, kProfile, kCoreProfile, kContextMajorVersion, 3, kContextMinorVersion,
        3,       0,     0};
    context_ = osmesa_.create(attributes.data(), nullptr);
    if (context_ == nullptr) {
      throw Error(ErrorCode::Unsupported, "OSMesa: refused a context of OpenGL 3.3 core");
    }
  }

  ~OsMesaContext() override { osmesa_.destroy(context_); }

  void make_current() override {
    if (osmesa_.make_current(context_, pixel_.data(), kUnsignedByte, 1, 1) == 0) {
      throw Error(ErrorCode::Unsupported, "OSMesa: refused to make its context current");
    }
  }

  void release() noexcept override { osmesa_.make_current(nullptr, nullptr, kUnsignedByte, 0, 0); }

  EntryPoint entry_point(const char* name) const override { return osmesa_.entry_point(name); }

 private:
  SharedLibrary library_;
  OsMesaFunctions osmesa_;
  OsMesaContextHandle context_ = nullptr;
  std::array<std::uint8_t, 4> pixel_{};  // the window OSMesa wants; pictures have their own targets
};

}  // namespace

std::unique_ptr<GlContext> open_osmesa_context() { return std::make_unique<OsMesaContext>(); }

}  // namespace nacre

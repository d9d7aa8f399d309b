#include "io/gdcm_module.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include <string>

#include "core/error.h"

namespace nacre {
namespace {

constexpr const char* kModule = "libnacre_gdcm.so";

[[noreturn]] void throw_cannot_load() {
  const char* reason = dlerror();  // what the last call said; the next one takes it away
  throw Error(
      ErrorCode::Unsupported,
      fmt::format("{}: found {}, expected the module that reads DICOM, installed with nacre",
                  kModule, reason == nullptr ? "no reason" : reason));
}

template <class Function>
Function* function_of(void* module, const char* name) {
  void* address = dlsym(module, name);
  if (address == nullptr) throw_cannot_load();
  return reinterpret_cast<Function*>(address);
}

}  // namespace

GdcmModule load_gdcm() {
  // Never unloaded: GDCM leaves functions behind that run at exit.
  void* module = dlopen(kModule, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (module == nullptr) throw_cannot_load();
  return {function_of<decltype(nacre_gdcm_describe)>(module, "nacre_gdcm_describe"),
          function_of<decltype(nacre_gdcm_decode)>(module, "nacre_gdcm_decode")};
}

}  // namespace nacre

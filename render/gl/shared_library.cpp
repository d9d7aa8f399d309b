#include "render/gl/shared_library.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include "core/error.h"

namespace nacre {

SharedLibrary::SharedLibrary(std::initializer_list<const char*> names) {
  for (const char* name : names) {
    name_ = name;
    handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle_ != nullptr) return;
  }
  const char* why = dlerror();
  throw Error(ErrorCode::Unsupported,
              fmt::format("{}: found no such library ({})", name_, why != nullptr ? why : ""));
}

SharedLibrary::~SharedLibrary() { dlclose(handle_); }

SharedLibrary::EntryPoint SharedLibrary::find(const char* symbol) const noexcept {
  return reinterpret_cast<EntryPoint>(dlsym(handle_, symbol));
}

SharedLibrary::EntryPoint SharedLibrary::require_any(const char* symbol) const {
  const EntryPoint function = find(symbol);
  if (function == nullptr) {
    throw Error(ErrorCode::Unsupported, fmt::format("{}: found no {}", name_, symbol));
  }
  return function;
}

}  // namespace nacre

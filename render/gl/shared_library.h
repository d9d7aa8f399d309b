#pragma once

#include <initializer_list>

namespace nacre {

/// A shared library loaded at run time, its symbols kept to itself (RTLD_LOCAL), so that GL
/// libraries whose symbols have the same names can be loaded side by side.
///
/// Stays mapped until the process ends: drivers leave threads and thread-local data behind that do
/// not survive unmapping.
class SharedLibrary {
 public:
  using EntryPoint = void (*)();

  /// Loads the first of these that the loader finds ("libEGL.so.1").
  /// @throws Error  Unsupported if it finds none, naming the last and why
  explicit SharedLibrary(std::initializer_list<const char*> names);
  ~SharedLibrary();
  SharedLibrary(const SharedLibrary&) = delete;
  SharedLibrary& operator=(const SharedLibrary&) = delete;

  /// Address of a function, null if the library has none of that name.
  EntryPoint find(const char* symbol) const noexcept;

  /// The function of that name.
  /// @throws Error  Unsupported if the library has none
  template <class Pointer>
  Pointer require(const char* symbol) const {
    return reinterpret_cast<Pointer>(require_any(symbol));
  }

 private:
  EntryPoint require_any(const char* symbol) const;

  const char* name_ = "";
  void* handle_ = nullptr;
};

}  // namespace nacre

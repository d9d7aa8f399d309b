#pragma once

namespace nacre {

/// An OpenGL context without a window, of whatever kind. Frees all it holds when destroyed.
///
/// Belongs to no thread: it may be made current on any, on one at a time.
class GlContext {
 public:
  /// Any function's address, to be cast to its own type before it is called.
  using EntryPoint = void (*)();

  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// @throws Error  Unsupported if the driver refuses
  virtual void make_current() = 0;

  /// Leaves the calling thread without a current context.
  virtual void release() noexcept = 0;

  /// Address of a GL function, null if the driver has none of that name.
  virtual EntryPoint entry_point(const char* name) const = 0;

 protected:
  GlContext() = default;
};

/// Keeps a context current as long as it lives.
///
/// Mesa's EGL and OSMesa share the thread's dispatch table but do not know of each other, so each
/// context is released after use: then any number of either kind live side by side.
class CurrentContext {
 public:
  explicit CurrentContext(GlContext& context) : context_(context) { context_.make_current(); }
  ~CurrentContext() { context_.release(); }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;

 private:
  GlContext& context_;
};

}  // namespace nacre

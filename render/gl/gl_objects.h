#pragma once

#include <string_view>
#include <utility>

#include "render/gl/gl_functions.h"

namespace nacre {

/// Owns one GL object by its name; deletes it when destroyed, with its context current.
///
/// @tparam Delete  deletes the object of that name, given the table
template <void (*Delete)(const GlFunctions&, unsigned)>
class GlObject {
 public:
  GlObject() = default;
  GlObject(const GlFunctions& gl, unsigned id) : gl_(&gl), id_(id) {}
  GlObject(GlObject&& other) noexcept : gl_(other.gl_), id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(id_, other.id_);
    return *this;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;
  ~GlObject() {
    if (id_ != 0) Delete(*gl_, id_);
  }

  unsigned id() const noexcept { return id_; }

 private:
  const GlFunctions* gl_ = nullptr;  // outlives the object, as its context does
  unsigned id_ = 0;
};

namespace gl_delete {
inline void buffer(const GlFunctions& gl, unsigned id) { gl.delete_buffers(1, &id); }
inline void vertex_array(const GlFunctions& gl, unsigned id) { gl.delete_vertex_arrays(1, &id); }
inline void framebuffer(const GlFunctions& gl, unsigned id) { gl.delete_framebuffers(1, &id); }
inline void renderbuffer(const GlFunctions& gl, unsigned id) { gl.delete_renderbuffers(1, &id); }
inline void texture(const GlFunctions& gl, unsigned id) { gl.delete_textures(1, &id); }
inline void program(const GlFunctions& gl, unsigned id) { gl.delete_program(id); }
inline void shader(const GlFunctions& gl, unsigned id) { gl.delete_shader(id); }
}  // namespace gl_delete

using GlBuffer = GlObject<gl_delete::buffer>;
using GlVertexArray = GlObject<gl_delete::vertex_array>;
using GlFramebuffer = GlObject<gl_delete::framebuffer>;
using GlRenderbuffer = GlObject<gl_delete::renderbuffer>;
using GlTexture = GlObject<gl_delete::texture>;
using GlProgram = GlObject<gl_delete::program>;
using GlShader = GlObject<gl_delete::shader>;

GlBuffer make_buffer(const GlFunctions& gl);
GlVertexArray make_vertex_array(const GlFunctions& gl);
GlFramebuffer make_framebuffer(const GlFunctions& gl);
GlRenderbuffer make_renderbuffer(const GlFunctions& gl);
GlTexture make_texture(const GlFunctions& gl);

/// Compiles and links a program of a vertex and a fragment stage.
/// @throws Error  Unsupported with the driver's log if it refuses
GlProgram make_program(const GlFunctions& gl, const char* vertex_source,
                       const char* fragment_source);

/// @throws std::bad_alloc  if the driver ran out of memory since the last call
/// @throws Error           Unsupported for any other GL error since then, naming `what` was done
void check_gl(const GlFunctions& gl, std::string_view what);

}  // namespace nacre

#include "render/gl/gl_objects.h"

#include <GL/glcorearb.h>
#include <fmt/core.h>

#include <cstddef>
#include <new>
#include <string>

#include "core/error.h"

namespace nacre {
namespace {

GlShader compile(const GlFunctions& gl, unsigned type, const char* source) {
  GlShader shader(gl, gl.create_shader(type));
  gl.shader_source(shader.id(), 1, &source, nullptr);
  gl.compile_shader(shader.id());
  int compiled = 0;
  gl.get_shaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (compiled == 0) {
    std::string log(1024, '\0');
    int length = 0;
    gl.get_shader_info_log(shader.id(), static_cast<int>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    throw Error(ErrorCode::Unsupported, "OpenGL: refused a shader: " + log);
  }
  return shader;
}

}  // namespace

GlBuffer make_buffer(const GlFunctions& gl) {
  unsigned id = 0;
  gl.gen_buffers(1, &id);
  return {gl, id};
}

GlVertexArray make_vertex_array(const GlFunctions& gl) {
  unsigned id = 0;
  gl.gen_vertex_arrays(1, &id);
  return {gl, id};
}

GlFramebuffer make_framebuffer(const GlFunctions& gl) {
  unsigned id = 0;
  gl.gen_framebuffers(1, &id);
  return {gl, id};
}

GlRenderbuffer make_renderbuffer(const GlFunctions& gl) {
  unsigned id = 0;
  gl.gen_renderbuffers(1, &id);
  return {gl, id};
}

GlTexture make_texture(const GlFunctions& gl) {
  unsigned id = 0;
  gl.gen_textures(1, &id);
  return {gl, id};
}

GlProgram make_program(const GlFunctions& gl, const char* vertex_source,
                       const char* fragment_source) {
  const GlShader vertex = compile(gl, GL_VERTEX_SHADER, vertex_source);
  const GlShader fragment = compile(gl, GL_FRAGMENT_SHADER, fragment_source);
  GlProgram program(gl, gl.create_program());
  gl.attach_shader(program.id(), vertex.id());
  gl.attach_shader(program.id(), fragment.id());
  gl.link_program(program.id());
  int linked = 0;
  gl.get_programiv(program.id(), GL_LINK_STATUS, &linked);
  if (linked == 0) {
    std::string log(1024, '\0');
    int length = 0;
    gl.get_program_info_log(program.id(), static_cast<int>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    throw Error(ErrorCode::Unsupported, "OpenGL: refused to link a program: " + log);
  }
  return program;
}

void check_gl(const GlFunctions& gl, std::string_view what) {
  const unsigned error = gl.get_error();
  if (error == GL_NO_ERROR) return;
  if (error == GL_OUT_OF_MEMORY) throw std::bad_alloc();
  throw Error(ErrorCode::Unsupported, fmt::format("OpenGL: {}: error {:#x}", what, error));
}

}  // namespace nacre

#include "render/gl/gl_functions.h"

#include <GL/glcorearb.h>
#include <fmt/core.h>

#include "core/error.h"
#include "render/gl/gl_context.h"

namespace nacre {
namespace {

/// Loads `Pointer`, the type that the GL header gives the function; assigning it to the table's
/// entry compiles only if the two types agree.
template <class Pointer>
Pointer load(const GlContext& context, const char* name) {
  const auto function = reinterpret_cast<Pointer>(context.entry_point(name));
  if (function == nullptr) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("OpenGL: found no {}, expected OpenGL 3.3 core", name));
  }
  return function;
}

void load_objects(GlFunctions& gl, const GlContext& context) {
  gl.attach_shader = load<PFNGLATTACHSHADERPROC>(context, "glAttachShader");
  gl.bind_buffer = load<PFNGLBINDBUFFERPROC>(context, "glBindBuffer");
  gl.bind_framebuffer = load<PFNGLBINDFRAMEBUFFERPROC>(context, "glBindFramebuffer");
  gl.bind_renderbuffer = load<PFNGLBINDRENDERBUFFERPROC>(context, "glBindRenderbuffer");
  gl.bind_texture = load<PFNGLBINDTEXTUREPROC>(context, "glBindTexture");
  gl.bind_vertex_array = load<PFNGLBINDVERTEXARRAYPROC>(context, "glBindVertexArray");
  gl.buffer_data = load<PFNGLBUFFERDATAPROC>(context, "glBufferData");
  gl.buffer_sub_data = load<PFNGLBUFFERSUBDATAPROC>(context, "glBufferSubData");
  gl.check_framebuffer_status =
      load<PFNGLCHECKFRAMEBUFFERSTATUSPROC>(context, "glCheckFramebufferStatus");
  gl.compile_shader = load<PFNGLCOMPILESHADERPROC>(context, "glCompileShader");
  gl.create_program = load<PFNGLCREATEPROGRAMPROC>(context, "glCreateProgram");
  gl.create_shader = load<PFNGLCREATESHADERPROC>(context, "glCreateShader");
  gl.delete_buffers = load<PFNGLDELETEBUFFERSPROC>(context, "glDeleteBuffers");
  gl.delete_framebuffers = load<PFNGLDELETEFRAMEBUFFERSPROC>(context, "glDeleteFramebuffers");
  gl.delete_program = load<PFNGLDELETEPROGRAMPROC>(context, "glDeleteProgram");
  gl.delete_renderbuffers = load<PFNGLDELETERENDERBUFFERSPROC>(context, "glDeleteRenderbuffers");
  gl.delete_shader = load<PFNGLDELETESHADERPROC>(context, "glDeleteShader");
  gl.delete_textures = load<PFNGLDELETETEXTURESPROC>(context, "glDeleteTextures");
  gl.delete_vertex_arrays = load<PFNGLDELETEVERTEXARRAYSPROC>(context, "glDeleteVertexArrays");
  gl.framebuffer_renderbuffer =
      load<PFNGLFRAMEBUFFERRENDERBUFFERPROC>(context, "glFramebufferRenderbuffer");
  gl.framebuffer_texture_2d =
      load<PFNGLFRAMEBUFFERTEXTURE2DPROC>(context, "glFramebufferTexture2D");
  gl.gen_buffers = load<PFNGLGENBUFFERSPROC>(context, "glGenBuffers");
  gl.gen_framebuffers = load<PFNGLGENFRAMEBUFFERSPROC>(context, "glGenFramebuffers");
  gl.gen_renderbuffers = load<PFNGLGENRENDERBUFFERSPROC>(context, "glGenRenderbuffers");
  gl.gen_textures = load<PFNGLGENTEXTURESPROC>(context, "glGenTextures");
  gl.gen_vertex_arrays = load<PFNGLGENVERTEXARRAYSPROC>(context, "glGenVertexArrays");
  gl.link_program = load<PFNGLLINKPROGRAMPROC>(context, "glLinkProgram");
  gl.renderbuffer_storage = load<PFNGLRENDERBUFFERSTORAGEPROC>(context, "glRenderbufferStorage");
  gl.shader_source = load<PFNGLSHADERSOURCEPROC>(context, "glShaderSource");
  gl.tex_image_2d = load<PFNGLTEXIMAGE2DPROC>(context, "glTexImage2D");
  gl.tex_parameteri = load<PFNGLTEXPARAMETERIPROC>(context, "glTexParameteri");
}

void load_state(GlFunctions& gl, const GlContext& context) {
  gl.active_texture = load<PFNGLACTIVETEXTUREPROC>(context, "glActiveTexture");
  gl.blend_func = load<PFNGLBLENDFUNCPROC>(context, "glBlendFunc");
  gl.cull_face = load<PFNGLCULLFACEPROC>(context, "glCullFace");
  gl.depth_func = load<PFNGLDEPTHFUNCPROC>(context, "glDepthFunc");
  gl.depth_range = load<PFNGLDEPTHRANGEPROC>(context, "glDepthRange");
  gl.disable = load<PFNGLDISABLEPROC>(context, "glDisable");
  gl.draw_buffer = load<PFNGLDRAWBUFFERPROC>(context, "glDrawBuffer");
  gl.enable = load<PFNGLENABLEPROC>(context, "glEnable");
  gl.enable_vertex_attrib_array =
      load<PFNGLENABLEVERTEXATTRIBARRAYPROC>(context, "glEnableVertexAttribArray");
  gl.front_face = load<PFNGLFRONTFACEPROC>(context, "glFrontFace");
  gl.pixel_storei = load<PFNGLPIXELSTOREIPROC>(context, "glPixelStorei");
  gl.read_buffer = load<PFNGLREADBUFFERPROC>(context, "glReadBuffer");
  gl.use_program = load<PFNGLUSEPROGRAMPROC>(context, "glUseProgram");
  gl.vertex_attrib_pointer = load<PFNGLVERTEXATTRIBPOINTERPROC>(context, "glVertexAttribPointer");
  gl.viewport = load<PFNGLVIEWPORTPROC>(context, "glViewport");
}

void load_uniforms(GlFunctions& gl, const GlContext& context) {
  gl.uniform_1f = load<PFNGLUNIFORM1FPROC>(context, "glUniform1f");
  gl.uniform_1i = load<PFNGLUNIFORM1IPROC>(context, "glUniform1i");
  gl.uniform_2fv = load<PFNGLUNIFORM2FVPROC>(context, "glUniform2fv");
  gl.uniform_3fv = load<PFNGLUNIFORM3FVPROC>(context, "glUniform3fv");
  gl.uniform_4fv = load<PFNGLUNIFORM4FVPROC>(context, "glUniform4fv");
  gl.uniform_matrix_3fv = load<PFNGLUNIFORMMATRIX3FVPROC>(context, "glUniformMatrix3fv");
  gl.uniform_matrix_4fv = load<PFNGLUNIFORMMATRIX4FVPROC>(context, "glUniformMatrix4fv");
}

void load_queries_and_drawing(GlFunctions& gl, const GlContext& context) {
  gl.clear_buffer_fv = load<PFNGLCLEARBUFFERFVPROC>(context, "glClearBufferfv");
  gl.draw_elements_base_vertex =
      load<PFNGLDRAWELEMENTSBASEVERTEXPROC>(context, "glDrawElementsBaseVertex");
  gl.get_error = load<PFNGLGETERRORPROC>(context, "glGetError");
  gl.get_integerv = load<PFNGLGETINTEGERVPROC>(context, "glGetIntegerv");
  gl.get_program_info_log = load<PFNGLGETPROGRAMINFOLOGPROC>(context, "glGetProgramInfoLog");
  gl.get_programiv = load<PFNGLGETPROGRAMIVPROC>(context, "glGetProgramiv");
  gl.get_shader_info_log = load<PFNGLGETSHADERINFOLOGPROC>(context, "glGetShaderInfoLog");
  gl.get_shaderiv = load<PFNGLGETSHADERIVPROC>(context, "glGetShaderiv");
  gl.get_string = load<PFNGLGETSTRINGPROC>(context, "glGetString");
  gl.get_uniform_location = load<PFNGLGETUNIFORMLOCATIONPROC>(context, "glGetUniformLocation");
  gl.read_pixels = load<PFNGLREADPIXELSPROC>(context, "glReadPixels");
}

}  // namespace

GlFunctions load_gl_functions(const GlContext& context) {
  GlFunctions gl{};
  load_objects(gl, context);
  load_state(gl, context);
  load_uniforms(gl, context);
  load_queries_and_drawing(gl, context);
  return gl;
}

}  // namespace nacre

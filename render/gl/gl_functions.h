#pragma once

#include <cstddef>

namespace nacre {

class GlContext;

/// The OpenGL 3.3 core entry points the renderer calls, as one context hands them out.
///
/// Nothing links libGL or libOSMesa, whose symbols have the same names: each context fills its own
/// table, so several can live in one process. The types are those of <GL/glcorearb.h> spelled out
/// (GLenum = unsigned, GLsizeiptr = ptrdiff_t, ...); loading them checks that they agree.
struct GlFunctions {
  void (*active_texture)(unsigned unit);
  void (*attach_shader)(unsigned program, unsigned shader);
  void (*bind_buffer)(unsigned target, unsigned buffer);
  void (*bind_framebuffer)(unsigned target, unsigned framebuffer);
  void (*bind_renderbuffer)(unsigned target, unsigned renderbuffer);
  void (*bind_texture)(unsigned target, unsigned texture);
  void (*bind_vertex_array)(unsigned array);
  void (*blend_func)(unsigned source, unsigned destination);
  void (*buffer_data)(unsigned target, std::ptrdiff_t size, const void* data, unsigned usage);
  void (*buffer_sub_data)(unsigned target, std::ptrdiff_t offset, std::ptrdiff_t size,
                          const void* data);
  unsigned (*check_framebuffer_status)(unsigned target);
  void (*clear_buffer_fv)(unsigned buffer, int index, const float* value);
  void (*compile_shader)(unsigned shader);
  unsigned (*create_program)();
  unsigned (*create_shader)(unsigned type);
  void (*cull_face)(unsigned mode);
  void (*delete_buffers)(int n, const unsigned* buffers);
  void (*delete_framebuffers)(int n, const unsigned* framebuffers);
  void (*delete_program)(unsigned program);
  void (*delete_renderbuffers)(int n, const unsigned* renderbuffers);
  void (*delete_shader)(unsigned shader);
  void (*delete_textures)(int n, const unsigned* textures);
  void (*delete_vertex_arrays)(int n, const unsigned* arrays);
  void (*depth_func)(unsigned func);
  void (*depth_range)(double near_depth, double far_depth);
  void (*disable)(unsigned cap);
  void (*draw_buffer)(unsigned buffer);
  void (*draw_elements_base_vertex)(unsigned mode, int count, unsigned type, const void* indices,
                                    int base_vertex);
  void (*enable)(unsigned cap);
  void (*enable_vertex_attrib_array)(unsigned index);
  void (*framebuffer_renderbuffer)(unsigned target, unsigned attachment, unsigned buffer_target,
                                   unsigned renderbuffer);
  void (*framebuffer_texture_2d)(unsigned target, unsigned attachment, unsigned texture_target,
                                 unsigned texture, int level);
  void (*front_face)(unsigned mode);
  void (*gen_buffers)(int n, unsigned* buffers);
  void (*gen_framebuffers)(int n, unsigned* framebuffers);
  void (*gen_renderbuffers)(int n, unsigned* renderbuffers);
  void (*gen_textures)(int n, unsigned* textures);
  void (*gen_vertex_arrays)(int n, unsigned* arrays);
  unsigned (*get_error)();
  void (*get_integerv)(unsigned name, int* values);
  void (*get_program_info_log)(unsigned program, int size, int* length, char* log);
  void (*get_programiv)(unsigned program, unsigned name, int* value);
  void (*get_shader_info_log)(unsigned shader, int size, int* length, char* log);
  void (*get_shaderiv)(unsigned shader, unsigned name, int* value);
  const unsigned char* (*get_string)(unsigned name);
  int (*get_uniform_location)(unsigned program, const char* name);
  void (*link_program)(unsigned program);
  void (*pixel_storei)(unsigned name, int value);
  void (*read_buffer)(unsigned buffer);
  void (*read_pixels)(int x, int y, int width, int height, unsigned format, unsigned type,
                      void* pixels);
  void (*renderbuffer_storage)(unsigned target, unsigned format, int width, int height);
  void (*shader_source)(unsigned shader, int count, const char* const* text, const int* lengths);
  void (*tex_image_2d)(unsigned target, int level, int internal_format, int width, int height,
                       int border, unsigned format, unsigned type, const void* pixels);
  void (*tex_parameteri)(unsigned target, unsigned name, int value);
  void (*uniform_1f)(int location, float value);
  void (*uniform_1i)(int location, int value);
  void (*uniform_2fv)(int location, int count, const float* value);
  void (*uniform_3fv)(int location, int count, const float* value);
  void (*uniform_4fv)(int location, int count, const float* value);
  void (*uniform_matrix_3fv)(int location, int count, unsigned char transpose, const float* value);
  void (*uniform_matrix_4fv)(int location, int count, unsigned char transpose, const float* value);
  void (*use_program)(unsigned program);
  void (*vertex_attrib_pointer)(unsigned index, int size, unsigned type, unsigned char normalized,
                                int stride, const void* offset);
  void (*viewport)(int x, int y, int width, int height);
};

/// Fills the table through the context's own loader.
///
/// @pre           the context is current
/// @throws Error  Unsupported if an entry point is missing
GlFunctions load_gl_functions(const GlContext& context);

}  // namespace nacre

#include "render/gl/tool_buffers.h"

#include <GL/glcorearb.h>

#include "render/flat_mesh.h"
#include "render/scene_facts.h"

namespace nacre {
namespace {

template <class Element>
std::size_t copy(const GlFunctions& gl, unsigned target, const GlBuffer& buffer,
                 const std::vector<Element>& list) {
  const std::size_t bytes = list.size() * sizeof(Element);
  gl.bind_buffer(target, buffer.id());
  gl.buffer_data(target, static_cast<std::ptrdiff_t>(bytes), list.data(), GL_STATIC_DRAW);
  return bytes;
}

void describe_attribute(const GlFunctions& gl, unsigned index) {
  gl.enable_vertex_attrib_array(index);
  gl.vertex_attrib_pointer(index, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
}

template <class Element>
void append(std::vector<Element>& list, const std::vector<Element>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

}  // namespace

ToolBuffers::ToolBuffers(const GlFunctions& gl, std::span<const Tool> tools,
                         const glm::dvec3& center_mm)
    : gl_(&gl),
      array_(make_vertex_array(gl)),
      positions_(make_buffer(gl)),
      normals_(make_buffer(gl)),
      triangles_(make_buffer(gl)) {
  FlatMesh all;
  for (const Tool& tool : tools) {
    const FlatMesh mesh = flat_mesh(local_positions(tool, center_mm), tool.mesh.triangles);
    parts_.push_back({3 * all.triangles.size(), static_cast<int>(3 * mesh.triangles.size()),
                      static_cast<int>(all.positions.size()), tool.color});
    append(all.positions, mesh.positions);
    append(all.normals, mesh.normals);
    append(all.triangles, mesh.triangles);
  }
  gl.bind_vertex_array(array_.id());
  bytes_ += copy(gl, GL_ELEMENT_ARRAY_BUFFER, triangles_, all.triangles);
  bytes_ += copy(gl, GL_ARRAY_BUFFER, positions_, all.positions);
  describe_attribute(gl, 0);
  bytes_ += copy(gl, GL_ARRAY_BUFFER, normals_, all.normals);
  describe_attribute(gl, 1);
  check_gl(gl, "copying the tools");
}

void ToolBuffers::bind() const { gl_->bind_vertex_array(array_.id()); }

void ToolBuffers::draw(std::uint32_t tool) const {
  const Part& part = parts_[tool];
  // OpenGL takes the offset into the index buffer as a pointer.
  const std::uintptr_t offset = part.first_index * sizeof(std::uint32_t);
  gl_->draw_elements_base_vertex(
      GL_TRIANGLES, part.index_count, GL_UNSIGNED_INT,
      reinterpret_cast<const void*>(offset),  // NOLINT(performance-no-int-to-ptr)
      part.base_vertex);
}

}  // namespace nacre

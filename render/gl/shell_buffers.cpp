#include "render/gl/shell_buffers.h"

#include <GL/glcorearb.h>
#include <fmt/core.h>

#include <limits>
#include <optional>

#include "core/error.h"
#include "core/volume_border.h"
#include "render/vertex_normals.h"

namespace nacre {
namespace {

/// OpenGL counts the corners of a draw in an int.
constexpr std::size_t kMost = std::numeric_limits<int>::max();

}  // namespace

ShellBuffers::ShellBuffers(const GlFunctions& gl, const ShellSet& set,
                           std::span<const std::uint32_t> shells, bool normals)
    : gl_(&gl),
      parts_(set.shells.size()),
      array_(make_vertex_array(gl)),
      positions_(make_buffer(gl)),
      triangles_(make_buffer(gl)) {
  if (normals) normals_ = make_buffer(gl);
  place(set, shells);
  copy(set);
}

void ShellBuffers::place(const ShellSet& set, std::span<const std::uint32_t> shells) {
  for (const std::uint32_t shell : shells) {
    const TriangleMesh& surface = set.shells.at(shell).surface;
    Part& part = parts_[shell];
    if (part.held) continue;
    if (3 * surface.triangles.size() > kMost || vertices_ > kMost) {
      throw Error(ErrorCode::Unsupported,
                  fmt::format("shell {}: found {} triangles, expected {} corners at most",
                              shell + 1, surface.triangles.size(), kMost));
    }
    part = {indices_, static_cast<int>(3 * surface.triangles.size()), static_cast<int>(vertices_),
            true};
    indices_ += 3 * surface.triangles.size();
    vertices_ += surface.positions.size();
  }
  bytes_ = (normals_ ? 2 : 1) * vertices_ * sizeof(glm::vec3) + indices_ * sizeof(std::uint32_t);
}

void ShellBuffers::make_room(const GlBuffer& buffer, unsigned attribute) const {
  gl_->bind_buffer(GL_ARRAY_BUFFER, buffer.id());
  gl_->buffer_data(GL_ARRAY_BUFFER, static_cast<std::ptrdiff_t>(vertices_ * sizeof(glm::vec3)),
                   nullptr, GL_STATIC_DRAW);
  gl_->enable_vertex_attrib_array(attribute);
  gl_->vertex_attrib_pointer(attribute, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
}

void ShellBuffers::copy_vertices(const GlBuffer& buffer, const Part& part,
                                 const std::vector<glm::vec3>& vertices) const {
  const auto first = static_cast<std::size_t>(part.base_vertex);
  gl_->bind_buffer(GL_ARRAY_BUFFER, buffer.id());
  gl_->buffer_sub_data(GL_ARRAY_BUFFER, static_cast<std::ptrdiff_t>(first * sizeof(glm::vec3)),
                       static_cast<std::ptrdiff_t>(vertices.size() * sizeof(glm::vec3)),
                       vertices.data());
}

void ShellBuffers::copy(const ShellSet& set) {
  gl_->bind_vertex_array(array_.id());
  gl_->bind_buffer(GL_ELEMENT_ARRAY_BUFFER, triangles_.id());
  gl_->buffer_data(GL_ELEMENT_ARRAY_BUFFER,
                   static_cast<std::ptrdiff_t>(indices_ * sizeof(std::uint32_t)), nullptr,
                   GL_STATIC_DRAW);
  make_room(positions_, 0);
  if (normals_) make_room(*normals_, 1);
  check_gl(*gl_, "room for the shells");
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (!parts_[i].held) continue;
    const std::optional<TriangleMesh> within = within_border(set, set.shells[i].surface);
    const TriangleMesh& surface = within ? *within : set.shells[i].surface;
    copy_vertices(positions_, parts_[i], surface.positions);
    if (normals_) copy_vertices(*normals_, parts_[i], vertex_normals(surface));
    gl_->buffer_sub_data(GL_ELEMENT_ARRAY_BUFFER,
                         static_cast<std::ptrdiff_t>(parts_[i].first_index * sizeof(std::uint32_t)),
                         static_cast<std::ptrdiff_t>(surface.triangles.size() * sizeof(glm::uvec3)),
                         surface.triangles.data());
  }
  check_gl(*gl_, "copying the shells");
}

bool ShellBuffers::holds(std::uint32_t shell) const {
  return shell < parts_.size() && parts_[shell].held;
}

void ShellBuffers::bind() const { gl_->bind_vertex_array(array_.id()); }

void ShellBuffers::draw(std::uint32_t shell) const {
  const Part& part = parts_[shell];
  // OpenGL takes the offset into the index buffer as a pointer.
  const std::uintptr_t offset = part.first_index * sizeof(std::uint32_t);
  gl_->draw_elements_base_vertex(
      GL_TRIANGLES, part.index_count, GL_UNSIGNED_INT,
      reinterpret_cast<const void*>(offset),  // NOLINT(performance-no-int-to-ptr)
      part.base_vertex);
}

}  // namespace nacre

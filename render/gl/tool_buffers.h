#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/tool.h"
#include "render/gl/gl_objects.h"

namespace nacre {

/// Tools as one vertex and one index buffer, flat normals with them.
class ToolBuffers {
 public:
  /// @param center_mm        LPS; what positions are relative to
  /// @throws std::bad_alloc  if the driver has no room for them
  ToolBuffers(const GlFunctions& gl, std::span<const Tool> tools, const glm::dvec3& center_mm);

  bool holds(std::uint32_t tool) const noexcept { return tool < parts_.size(); }

  /// Bytes of vertices and indices.
  std::size_t bytes() const noexcept { return bytes_; }

  const glm::vec3& color(std::uint32_t tool) const { return parts_[tool].color; }

  /// To be called before `draw`.
  void bind() const;

  /// Draws all of a tool's triangles.
  /// @pre  holds(tool), bound
  void draw(std::uint32_t tool) const;

 private:
  struct Part {
    std::size_t first_index = 0;
    int index_count = 0;
    int base_vertex = 0;
    glm::vec3 color{0.0F};
  };

  const GlFunctions* gl_;
  std::vector<Part> parts_;
  std::size_t bytes_ = 0;
  GlVertexArray array_;
  GlBuffer positions_;
  GlBuffer normals_;
  GlBuffer triangles_;
};

}  // namespace nacre

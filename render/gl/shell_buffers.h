#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/shell_set.h"
#include "render/gl/gl_objects.h"

namespace nacre {

/// The shells of a set as one vertex and one index buffer: no state changes between shells.
class ShellBuffers {
 public:
  /// Copies the surfaces of these shells; with their smooth normals where they are to be lit.
  /// @throws std::bad_alloc  if the driver has no room for them
  ShellBuffers(const GlFunctions& gl, const ShellSet& set, std::span<const std::uint32_t> shells,
               bool normals);

  bool has_normals() const noexcept { return normals_.has_value(); }

  bool holds(std::uint32_t shell) const;

  /// Bytes of vertices, normals and indices.
  std::size_t bytes() const noexcept { return bytes_; }

  /// To be called before `draw`.
  void bind() const;

  /// Draws all of a shell's triangles.
  /// @pre  holds(shell), bound
  void draw(std::uint32_t shell) const;

 private:
  struct Part {
    std::size_t first_index = 0;
    int index_count = 0;
    int base_vertex = 0;
    bool held = false;
  };

  void place(const ShellSet& set, std::span<const std::uint32_t> shells);
  void make_room(const GlBuffer& buffer, unsigned attribute) const;
  void copy(const ShellSet& set);
  void copy_vertices(const GlBuffer& buffer, const Part& part,
                     const std::vector<glm::vec3>& vertices) const;

  const GlFunctions* gl_;
  std::vector<Part> parts_;  // one a shell of the set
  std::size_t vertices_ = 0;
  std::size_t indices_ = 0;
  std::size_t bytes_ = 0;
  GlVertexArray array_;
  GlBuffer positions_;
  std::optional<GlBuffer> normals_;
  GlBuffer triangles_;
};

}  // namespace nacre

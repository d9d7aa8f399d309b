#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/tool.h"
#include "render/cpu/cluster_kernel.h"
#include "render/cpu/mesh_clusters.h"
#include "render/ray_frame.h"

namespace nacre {

/// Tools cut into clusters, and what their triangles look like. Triangles of all tools are numbered
/// together, in the order of their corners; of two at one depth the first is seen.
class ToolMeshes {
 public:
  ToolMeshes() = default;

  /// @param center_mm  LPS; what positions are relative to
  ToolMeshes(std::span<const Tool> tools, const glm::dvec3& center_mm);

  bool holds(std::uint32_t tool) const noexcept { return tool < tools_.size(); }
  std::size_t bytes() const noexcept;

  /// @pre  holds(tool)
  const MeshClusters& mesh(std::uint32_t tool) const { return tools_[tool].mesh; }

  /// The number of the tool's first triangle.
  /// @pre  holds(tool)
  std::uint32_t first_triangle(std::uint32_t tool) const { return tools_[tool].first_triangle; }

  /// The colour of a triangle under a headlight, lit on both sides, times the cue.
  ///
  /// @param seen   what is seen in the pixel
  /// @param pixel  its centre, as `local_way` has it
  glm::vec3 color_at(const NearestKey& seen, const glm::dvec2& pixel, const RayFrame& rays) const;

 private:
  struct Part {
    MeshClusters mesh;
    std::uint32_t first_triangle = 0;
    glm::vec3 color{0.0F};
  };

  std::vector<Part> tools_;
  std::vector<glm::vec3> normals_;  // of all triangles; 0 for one without area
};

}  // namespace nacre

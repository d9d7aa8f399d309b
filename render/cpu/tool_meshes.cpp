#include "render/cpu/tool_meshes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/picture.h"
#include "render/scene_facts.h"

namespace nacre {
namespace {

void append_normals(const MeshClusters& mesh, std::vector<glm::vec3>& normals) {
  for (const Cluster& cluster : mesh.clusters) {
    const std::size_t count = cluster.triangles;
    const auto position = [&](std::size_t corner) {
      const float* x = mesh.positions.data() + cluster.first_position +
                       mesh.corners[cluster.first_corner + corner];
      return glm::dvec3(x[0], x[cluster.vertices], x[2 * std::size_t{cluster.vertices}]);
    };
    for (std::size_t t = 0; t < count; ++t) {
      const glm::dvec3 a = position(t);
      const glm::dvec3 across = glm::cross(position(t + count) - a, position(t + 2 * count) - a);
      const double length = glm::length(across);
      normals.push_back(length > 0.0 ? glm::vec3(across / length) : glm::vec3(0.0F));
    }
  }
}

}  // namespace

ToolMeshes::ToolMeshes(std::span<const Tool> tools, const glm::dvec3& center_mm) {
  for (const Tool& tool : tools) {
    tools_.push_back({cluster_mesh({local_positions(tool, center_mm), tool.mesh.triangles}),
                      static_cast<std::uint32_t>(normals_.size()), tool.color});
    append_normals(tools_.back().mesh, normals_);
  }
}

std::size_t ToolMeshes::bytes() const noexcept {
  std::size_t sum = normals_.size() * sizeof(glm::vec3);
  for (const Part& tool : tools_) sum += tool.mesh.bytes();
  return sum;
}

glm::vec3 ToolMeshes::color_at(const NearestKey& seen, const glm::dvec2& pixel,
                               const RayFrame& rays) const {
  const auto after = std::upper_bound(
      tools_.begin(), tools_.end(), seen.triangle,
      [](std::uint32_t number, const Part& tool) { return number < tool.first_triangle; });
  const glm::dvec3 way = glm::normalize(local_way(rays, pixel));
  const double cosine = std::abs(glm::dot(glm::dvec3(normals_[seen.triangle]), way));
  const double light = headlight(cosine) * cue_at_depth(rays, seen.depth_mm);
  return std::prev(after)->color * static_cast<float>(light);
}

}  // namespace nacre

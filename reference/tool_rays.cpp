#include "reference/tool_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <iterator>
#include <limits>

namespace nacre {
namespace {

TriangleRays posed_triangles(std::span<const Tool> tools) {
  std::vector<glm::dvec3> positions;
  std::vector<glm::uvec3> triangles;
  for (const Tool& tool : tools) {
    const auto offset = static_cast<std::uint32_t>(positions.size());
    for (const glm::vec3& p : tool.mesh.positions) {
      positions.emplace_back(tool.world_from_tool * glm::dvec4(glm::dvec3(p), 1.0));
    }
    for (const glm::uvec3& t : tool.mesh.triangles) triangles.push_back(t + offset);
  }
  return {std::move(positions), triangles};
}

/// Unit normal of a triangle; of one too thin to have any, the direction against the ray.
glm::dvec3 face_normal(const std::array<glm::dvec3, 3>& corners, const Ray& ray) {
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double length = glm::length(normal);
  return length > 0.0 ? normal / length : -ray.direction;
}

}  // namespace

ToolRays::ToolRays(std::span<const Tool> tools) : triangles_(posed_triangles(tools)) {
  std::uint32_t first = 0;
  for (const Tool& tool : tools) {
    colors_.push_back(tool.color);
    first_triangles_.push_back(first);
    first += static_cast<std::uint32_t>(tool.mesh.triangles.size());
  }
}

std::optional<ToolHit> ToolRays::nearest(const Ray& ray, const RayInterval& interval) const {
  const auto hit = triangles_.nearest(ray, interval);
  if (!hit) return std::nullopt;
  const auto after = std::ranges::upper_bound(first_triangles_, hit->triangle);
  const auto tool = static_cast<std::uint32_t>(after - first_triangles_.begin()) - 1;
  return ToolHit{hit->t_mm, tool, face_normal(triangles_.corners(hit->triangle), ray)};
}

glm::vec3 lit_tool(const ToolRays& tools, const Camera& camera, const DepthCue& cue, const Ray& ray,
                   const ToolHit& hit) {
  const double light = headlight(std::abs(glm::dot(hit.normal, ray.direction)));
  const double z = depth_z(camera, ray.origin_mm + hit.t_mm * ray.direction);
  return {glm::dvec3(tools.color(hit.tool)) * (light * beta(cue, std::clamp(z, 0.0, 1.0)))};
}

Picture make_picture(const Camera& camera, const ToolRays* tools) {
  Picture picture{make_image(camera.size.x, camera.size.y), std::nullopt};
  if (tools != nullptr && !tools->empty()) {
    picture.tools = make_tool_layer(camera.size.x, camera.size.y);
  }
  return picture;
}

double draw_tool_pixel(const ToolRays& tools, const Camera& camera, const DepthCue& cue,
                       const Ray& ray, int x, int y, ToolLayer& layer) {
  const auto hit = tools.nearest(ray, visible_interval(camera, ray, {}));
  if (!hit) return std::numeric_limits<double>::infinity();
  const auto pixel = static_cast<std::size_t>(x) +
                     static_cast<std::size_t>(layer.width) * static_cast<std::size_t>(y);
  layer.colors[pixel] = lit_tool(tools, camera, cue, ray, *hit);
  layer.covered[pixel] = 1;
  return hit->t_mm;
}

}  // namespace nacre

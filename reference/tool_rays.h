#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/camera.h"
#include "core/image.h"
#include "core/picture.h"
#include "core/tool.h"
#include "reference/triangle_rays.h"

namespace nacre {

/// Where a ray meets a tool.
struct ToolHit {
  double t_mm = 0.0;       ///< from the ray's origin
  std::uint32_t tool = 0;  ///< index into the tools
  glm::dvec3 normal{0.0};  ///< of the flat face, of unit length; its sign is the mesh's winding
};

/// The tools of a scene, for rays: posed in double, watertight, seen from both sides.
///
/// Safe to use from many threads.
class ToolRays {
 public:
  /// @param tools  finite positions and poses; may be none. Nothing of them is kept but copies
  explicit ToolRays(std::span<const Tool> tools);

  bool empty() const { return colors_.empty(); }

  /// The nearest face with t in the interval; between faces at the same t, that of the first tool.
  std::optional<ToolHit> nearest(const Ray& ray, const RayInterval& interval = {}) const;

  /// Color of a tool, as displayed.
  const glm::vec3& color(std::uint32_t tool) const { return colors_[tool]; }

 private:
  std::vector<glm::vec3> colors_;
  std::vector<std::uint32_t> first_triangles_;  ///< of each tool
  TriangleRays triangles_;
};

/// How a tool shines where a ray meets it: its colour under a headlight on the flat face, both
/// sides alike, times the cue at its depth, which counts as the nearest or farthest of the volume's
/// sphere outside it:
///
///     color * headlight(|normal . direction|) * beta(clamp(z, 0, 1)).
glm::vec3 lit_tool(const ToolRays& tools, const Camera& camera, const DepthCue& cue, const Ray& ray,
                   const ToolHit& hit);

/// A black picture of the camera's size, with a layer for tools where there are any.
/// @param tools  null: none
Picture make_picture(const Camera& camera, const ToolRays* tools);

/// Looks for tools along a pixel's ray, and puts the nearest into the layer's pixel. Slabs do not
/// cut tools: all of the ray in front of the eye counts.
///
/// @param layer  of the camera's size
/// @return       t of the tool, mm; infinity where there is none: the volume shows only before it
double draw_tool_pixel(const ToolRays& tools, const Camera& camera, const DepthCue& cue,
                       const Ray& ray, int x, int y, ToolLayer& layer);

}  // namespace nacre

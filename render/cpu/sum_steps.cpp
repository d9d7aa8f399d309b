#include "render/cpu/sum_steps.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace nacre {
namespace {

/// The greatest depth of a mesh beyond the start of the rays, or 0.
double reach_mm(const MeshClusters& mesh, const glm::dvec4& depth_from_local) {
  const glm::dvec3 way(depth_from_local);
  double reach = 0.0;
  for (const Cluster& cluster : mesh.clusters) {
    reach = std::max(reach, glm::dot(way, glm::dvec3(cluster.center_mm)) + depth_from_local.w +
                                glm::dot(glm::abs(way), glm::dvec3(cluster.extent_mm)));
  }
  return reach;
}

}  // namespace

SumSteps::SumSteps(const Pass& pass, const SceneMeshes& scene, const RayFrame& rays)
    : sum_(pass.kind == PassKind::Sum), cue_(rays.cue) {
  double weight = 0.0;
  std::size_t triangles = 0;
  for (const ShellDraw& draw : pass.draws) {
    weight = std::max(weight, std::abs(draw.weight));
    reach_mm_ = std::max(reach_mm_, reach_mm(*scene.shells[draw.shell], rays.depth_from_local));
    triangles += scene.shells[draw.shell]->triangles;
  }
  // Of c + c' d / 2, at one of its ends.
  const double cue = std::max(std::abs(cue_.x), std::abs(cue_.x + 0.5 * cue_.y * reach_mm_));
  const double most = weight * (sum_ ? reach_mm_ * cue : 1.0);
  // Each triangle covers a pixel once.
  const int bits = 61 - static_cast<int>(std::bit_width(triangles));
  const double steps = std::min<double>(kMostSteps, std::ldexp(1.0, bits));
  if (most > 0.0) step_ = most / steps;
}

Brightness<std::int64_t> SumSteps::of(const ShellDraw& draw) const {
  const double steps = draw.weight / step_;
  if (!sum_) return {.constant = static_cast<float>(steps)};
  return {.linear = static_cast<float>(steps * cue_.x),
          .square = static_cast<float>(0.5 * steps * cue_.y),
          .most_depth_mm = static_cast<float>(reach_mm_),
          .is_signed = true};
}

}  // namespace nacre

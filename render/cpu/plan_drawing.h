#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "core/camera.h"
#include "core/image.h"
#include "render/cpu/cluster_kernel.h"
#include "render/cpu/mesh_clusters.h"
#include "render/cpu/tool_meshes.h"
#include "render/plan.h"
#include "render/shell_renderer.h"

namespace nacre {

/// What plans draw.
struct SceneMeshes {
  glm::dvec3 center_mm{0.0};
  std::vector<const MeshClusters*> shells;  ///< those that the plan draws; others may be null
  const ToolMeshes* tools = nullptr;
};

/// Draws plans of maximum projections, sums and counts on all threads of the calling TBB arena.
/// Keeps its targets from picture to picture.
class PlanDrawing {
 public:
  explicit PlanDrawing(InstructionSet instructions);
  ~PlanDrawing();
  PlanDrawing(PlanDrawing&&) noexcept;
  PlanDrawing& operator=(PlanDrawing&&) noexcept;

  /// @pre  `cpu_objection` has none; the scene has all that the plan draws
  Picture draw(const Camera& camera, const Plan& plan, const SceneMeshes& scene);

  /// Of the last picture, without its time.
  const FrameStats& stats() const noexcept;

 private:
  class Targets;
  std::unique_ptr<Targets> targets_;
};

}  // namespace nacre

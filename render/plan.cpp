#include "render/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/volume_border.h"
#include "render/planning.h"
#include "render/tiles.h"

namespace nacre {
namespace {

using planning::Planning;
using planning::ShownShell;

void check(const SceneFacts& scene, const RenderOptions& options) {
  for (const std::uint32_t shell : options.hidden) {
    if (shell >= scene.shells.size()) {
      throw Error(ErrorCode::BadArgument, fmt::format("hidden shell: found {}, expected 1 to {}",
                                                      shell + 1, scene.shells.size()));
    }
  }
  check_cue(options.cue);
  check_slab(options.slab);
}

/// Where depth is counted from: where rays start, or the nearest of what is drawn, if that is
/// farther. Shells have nothing before it, and small numbers keep their digits.
RaySpan drawn_span(const Planning& planning) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const ShownShell& shell : planning.shells) {
    nearest = std::min(nearest, shell.depths_mm.lo);
  }
  if (!std::isfinite(nearest)) nearest = view_depth_of_slab(planning.camera, 0.0);
  return {std::max(planning.rays.start_mm, nearest), planning.rays.end_mm};
}

void plan_shells(Planning& planning) {
  switch (planning.options.mode) {
    case PictureMode::Max: planning::plan_max(planning); break;
    case PictureMode::Sum:
    case PictureMode::Count: planning::plan_crossings(planning); break;
    case PictureMode::Iso: planning::plan_lit(planning); break;
  }
}

}  // namespace

std::vector<std::uint32_t> shells_drawn(const Plan& plan) {
  std::vector<std::uint32_t> shells;
  for (const Pass& pass : plan.passes) {
    for (const ShellDraw& draw : pass.draws) shells.push_back(draw.shell);
  }
  std::sort(shells.begin(), shells.end());
  shells.erase(std::unique(shells.begin(), shells.end()), shells.end());
  return shells;
}

Plan make_plan(const SceneFacts& scene, const Camera& camera, const RenderOptions& options,
               const Capabilities& capabilities) {
  check(scene, options);
  Planning planning{.scene = scene, .camera = camera, .options = options};
  Plan& plan = planning.plan;
  plan.depth = options.depth;
  plan.target = options.target;
  plan.cue = options.cue;
  plan.normals = !options.rules.leave_out_normals;
  planning::find_tools(planning);
  planning::find_shells(planning);
  plan_shells(planning);
  plan.tiles = tiles(with_samples(camera, plan.samples).size, capabilities.max_target_side);
  planning::note_limits(planning);
  plan.rays = drawn_span(planning);
  if (options.mode != PictureMode::Iso && has_border(scene.volume)) {
    plan.columns = volume_silhouette(with_samples(camera, plan.samples), scene.volume.dims,
                                     scene.volume.world_from_voxel);
  }
  if (!plan.normals) planning.leave_out("normals", "nothing is lit");
  return plan;
}

}  // namespace nacre

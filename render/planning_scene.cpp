// What of a scene a picture shows: the tools and shells that rays meet.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "render/planning.h"

namespace nacre::planning {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Takes the shells for which the rule holds out of those shown, and says so.
void leave_out_if(Planning& planning, std::string_view why,
                  const std::function<bool(const ShownShell&)>& rule) {
  std::vector<ShownShell>& shells = planning.shells;
  const auto kept_end = std::stable_partition(shells.begin(), shells.end(), std::not_fn(rule));
  const std::vector<ShownShell> gone(kept_end, shells.end());
  shells.erase(kept_end, shells.end());
  if (!gone.empty()) planning.leave_out(describe_shells(planning, gone), why);
}

/// Every shell of the scene, with its bounds' depths.
std::vector<ShownShell> all_shells(const Planning& planning) {
  std::vector<ShownShell> shells;
  for (const ShellFacts& facts : planning.scene.shells) {
    ShownShell shell;
    shell.index = static_cast<std::uint32_t>(shells.size());
    shell.triangles = facts.triangles;
    shell.representative = facts.representative;
    shell.depths_mm = {kInfinity, -kInfinity};
    if (facts.triangles > 0) {
      shell.depths_mm = view_depths(planning.camera, planning.scene.center_mm, facts.bounds);
    }
    shells.push_back(shell);
  }
  return shells;
}

/// In sums a shell adds to the one around it, whether or not that one is in view.
void find_steps(const SceneFacts& scene, std::vector<ShownShell>& shells) {
  double around = 0.0;
  for (ShownShell& shell : shells) {
    const double summed =
        scene.shells[shell.index].sum_representative.value_or(shell.representative);
    shell.step = summed - around;
    if (shell.triangles > 0) around = summed;
  }
}

bool reached_by_tools(const Planning& planning, const ShownShell& shell) {
  if (shell.triangles == 0 || planning.tools.empty()) return false;
  if (!planning.options.rules.limit_occlusion) return true;
  const SceneFacts& scene = planning.scene;
  return std::any_of(planning.tools.begin(), planning.tools.end(), [&](std::uint32_t tool) {
    return may_hide(planning.camera, scene.center_mm, scene.tools[tool].bounds,
                    scene.shells[shell.index].bounds);
  });
}

void find_ends(const Planning& planning, ShownShell& shell) {
  const Interval& depths = shell.depths_mm;
  const RaySpan& rays = planning.rays;
  const double slab_start = view_depth_of_slab(planning.camera, planning.options.slab.near_mm);
  shell.reached = reached_by_tools(planning, shell);
  shell.starts_inside = shell.triangles > 0 && depths.lo <= rays.start_mm;
  shell.ends_inside = shell.reached || depths.hi > rays.end_mm;
  shell.cut_by_slab = depths.lo < slab_start || depths.hi > rays.end_mm;
}

/// Where rays start and end, tools aside.
RaySpan ray_span(const Camera& camera, const Slab& slab) {
  const double near_mm = camera.perspective ? near_plane_mm(camera) : -kInfinity;
  return {std::max(near_mm, view_depth_of_slab(camera, slab.near_mm)),
          view_depth_of_slab(camera, slab.far_mm)};
}

void leave_out_dark(Planning& planning) {
  if (planning.options.mode == PictureMode::Sum) {
    leave_out_if(planning, "dark: adds nothing to the emission around",
                 [](const ShownShell& shell) { return shell.step == 0.0; });
  } else if (planning.options.mode != PictureMode::Iso) {
    leave_out_if(planning, "dark: the emission shown is 0",
                 [](const ShownShell& shell) { return shell.representative <= 0.0; });
  }
}

void leave_out_unseen(Planning& planning) {
  const PlanRules& rules = planning.options.rules;
  if (rules.leave_out_outside_view) {
    leave_out_if(planning, "outside the view", [&](const ShownShell& shell) {
      return shell.triangles > 0 && outside_view(planning.camera, planning.scene.center_mm,
                                                 planning.scene.shells[shell.index].bounds);
    });
  }
  const RaySpan& rays = planning.rays;
  if (rays.end_mm <= rays.start_mm) {
    leave_out_if(planning, "slab: it ends before the rays start",
                 [](const ShownShell&) { return true; });
  } else if (rules.leave_out_outside_slab) {
    leave_out_if(planning, "outside the slab", [&](const ShownShell& shell) {
      // Before a perspective eye is outside the view, said above.
      const double slab_start = view_depth_of_slab(planning.camera, planning.options.slab.near_mm);
      return shell.triangles > 0 &&
             (shell.depths_mm.hi < slab_start || shell.depths_mm.lo > rays.end_mm);
    });
  }
}

std::string describe_tool(const Planning& planning, std::uint32_t tool) {
  return fmt::format("tool {} ({} triangles)", tool + 1, planning.scene.tools[tool].triangles);
}

/// View depths of all tools in view, from the near plane on.
Interval depths_of_tools(const Planning& planning) {
  Interval depths{kInfinity, -kInfinity};
  for (const std::uint32_t tool : planning.tools) {
    const Interval own =
        view_depths(planning.camera, planning.scene.center_mm, planning.scene.tools[tool].bounds);
    depths = {std::min(depths.lo, own.lo), std::max(depths.hi, own.hi)};
  }
  if (planning.camera.perspective) {
    depths.lo = std::max(depths.lo, near_plane_mm(planning.camera));
  }
  return depths;
}

}  // namespace

void find_tools(Planning& planning) {
  const bool all = !planning.options.rules.leave_out_outside_view;
  for (std::uint32_t tool = 0; tool < planning.scene.tools.size(); ++tool) {
    const ToolFacts& facts = planning.scene.tools[tool];
    if (facts.triangles == 0) {
      planning.leave_out(describe_tool(planning, tool), "empty");
    } else if (!all && outside_view(planning.camera, planning.scene.center_mm, facts.bounds)) {
      planning.leave_out(describe_tool(planning, tool), "outside the view");
    } else {
      planning.tools.push_back(tool);
    }
  }
  if (planning.tools.empty()) {
    planning.leave_out("tool colour", "no tool is in view");
    return;
  }
  Pass pass{.kind = PassKind::ToolLayer, .tools = planning.tools};
  for (const std::uint32_t tool : planning.tools) {
    pass.tool_triangles += planning.scene.tools[tool].triangles;
  }
  pass.depths_mm = depths_of_tools(planning);
  planning.plan.passes.push_back(std::move(pass));
}

void find_shells(Planning& planning) {
  planning.rays = ray_span(planning.camera, planning.options.slab);
  planning.shells = all_shells(planning);
  const std::vector<std::uint32_t>& hidden = planning.options.hidden;
  leave_out_if(planning, "hidden: the layer shows the previous shown shell",
               [&](const ShownShell& shell) {
                 return std::find(hidden.begin(), hidden.end(), shell.index) != hidden.end();
               });
  find_steps(planning.scene, planning.shells);
  if (planning.options.rules.leave_out_empty) {
    leave_out_if(planning, "empty: nothing reaches the level",
                 [](const ShownShell& shell) { return shell.triangles == 0; });
  }
  if (planning.options.rules.leave_out_dark) leave_out_dark(planning);
  leave_out_unseen(planning);
  for (ShownShell& shell : planning.shells) find_ends(planning, shell);
}

ShellDraw draw_of(const ShownShell& shell, Faces faces) {
  ShellDraw draw;
  draw.shell = shell.index;
  draw.triangles = shell.triangles;
  draw.faces = faces;
  draw.cut_by_slab = shell.cut_by_slab;
  draw.tools = shell.reached ? ToolCut::Texture : ToolCut::None;
  return draw;
}

}  // namespace nacre::planning

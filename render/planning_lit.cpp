// Lit shells: the nearest crossing of each ray.
#include <algorithm>
#include <glm/common.hpp>

#include "render/planning.h"

namespace nacre::planning {
namespace {

bool within(const Box& inner, const Box& outer) {
  return glm::min(inner.lo, outer.lo) == outer.lo && glm::max(inner.hi, outer.hi) == outer.hi;
}

/// A shell that no ray starts in hides those inside it.
void leave_out_enclosed(Planning& planning) {
  std::vector<ShownShell>& shells = planning.shells;
  const auto outermost = std::find_if(shells.begin(), shells.end(),
                                      [](const ShownShell& shell) { return shell.triangles > 0; });
  if (outermost == shells.end() || outermost->starts_inside) return;
  const Box& bounds = planning.scene.shells[outermost->index].bounds;
  const auto gone_from =
      std::stable_partition(outermost + 1, shells.end(), [&](const ShownShell& shell) {
        return shell.triangles == 0 || !within(planning.scene.shells[shell.index].bounds, bounds);
      });
  const std::vector<ShownShell> gone(gone_from, shells.end());
  shells.erase(gone_from, shells.end());
  if (!gone.empty()) {
    planning.leave_out(describe_shells(planning, gone),
                       "enclosed: the outermost shell shown hides them");
  }
}

}  // namespace

void plan_lit(Planning& planning) {
  if (planning.options.rules.leave_out_enclosed) leave_out_enclosed(planning);
  if (planning.shells.empty()) return;
  Pass pass{.kind = PassKind::Lit};
  pass.depths_mm = planning.shells.front().depths_mm;
  for (const ShownShell& shell : planning.shells) {
    const bool fronts = planning.options.rules.cull_faces && !shell.starts_inside;
    pass.draws.push_back(draw_of(shell, fronts ? Faces::Front : Faces::Both));
    pass.depths_mm.lo = std::min(pass.depths_mm.lo, shell.depths_mm.lo);
    pass.depths_mm.hi = std::max(pass.depths_mm.hi, shell.depths_mm.hi);
  }
  note_faces(planning, pass, "no ray starts inside: it meets the front first", "");
  planning.plan.passes.push_back(std::move(pass));
  planning.plan.normals = true;
  note_occlusion(planning);
}

}  // namespace nacre::planning

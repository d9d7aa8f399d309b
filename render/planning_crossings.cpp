// Sums and counts of crossings: all faces, in any order.
#include <fmt/core.h>

#include "core/error.h"
#include "render/planning.h"

namespace nacre::planning {

void plan_crossings(Planning& planning) {
  const RenderOptions& options = planning.options;
  const bool sum = options.mode == PictureMode::Sum;
  if (sum && options.target == TargetFormat::U8) {
    throw Error(ErrorCode::BadArgument,
                "target 8: found mode sum, expected 16f or 32f (emission * mm is above 1, and "
                "entering a shell counts negative)");
  }
  if (planning.shells.empty()) return;
  Pass pass{.kind = sum ? PassKind::Sum : PassKind::Count};
  for (const ShownShell& shell : planning.shells) {
    pass.draws.push_back(draw_of(shell, Faces::Both));
    pass.draws.back().weight = sum ? shell.step : shell.representative;
  }
  planning.plan.passes.push_back(std::move(pass));
  note_occlusion(planning);
  planning.leave_out("depth buffer", "crossings add up in any order");
}

}  // namespace nacre::planning

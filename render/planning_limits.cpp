// Where a scene goes past what the chosen formats hold: said, not repaired.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/planning.h"

namespace nacre::planning {
namespace {

constexpr double kGreatestHalf = 65504.0;
/// What a crossing loses of the partial sum in half floats, at the worst, and how much of a pixel
/// the crossings of all shells together may lose without a word.
constexpr double kHalfRounding = 0x1p-11;
constexpr double kMostLost = 0.1;

double steps_of(DepthFormat format) { return format == DepthFormat::D16 ? 65535.0 : 16777215.0; }

/// How far the shown shells reach along the viewing direction.
double reach_mm(const Planning& planning) {
  Interval reach{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const ShownShell& shell : planning.shells) {
    reach.lo = std::min(reach.lo, shell.depths_mm.lo);
    reach.hi = std::max(reach.hi, shell.depths_mm.hi);
  }
  return reach.hi - reach.lo;
}

/// What a pixel's terms of one sign may add up to, where each shell is crossed in and out once.
double greatest_sum(const Planning& planning, const Pass& pass) {
  const DepthCue& cue = planning.options.cue;
  const double factor = pass.kind == PassKind::Sum
                            ? reach_mm(planning) * std::max(beta(cue, 0.0), beta(cue, 1.0))
                            : 2.0 * std::max(beta(cue, 0.0), beta(cue, 1.0));
  double sum = 0.0;
  for (const ShellDraw& draw : pass.draws) sum += std::abs(draw.weight) * factor;
  return sum;
}

void check_half_floats(Planning& planning, const Pass& pass) {
  const double greatest = greatest_sum(planning, pass);
  if (greatest > kGreatestHalf) {
    planning.warn(fmt::format("target 16f: pixels may reach {:.4g}, and end at {}; 32f holds them",
                              greatest, kGreatestHalf));
  }
  const double lost = 2.0 * kHalfRounding * static_cast<double>(pass.draws.size());
  if (lost > kMostLost) {
    planning.warn(
        fmt::format("target 16f: roundings at the crossings of {} shells may add up to {:.0f} % of "
                    "a pixel; 32f holds them",
                    pass.draws.size(), 100.0 * lost));
  }
}

void check_bytes(Planning& planning, const Pass& pass) {
  const double greatest = greatest_sum(planning, pass);
  if (greatest <= 1.0) return;
  planning.warn(fmt::format(
      "target 8: counts may reach {:.4g}, and end at 1; 32f holds them, 16f nearly", greatest));
}

/// A cued maximum keeps emissions in steps: shells under half of one are black everywhere.
void check_steps(Planning& planning, const Pass& pass) {
  const Plan& plan = planning.plan;
  if (plan.depth == DepthFormat::D32F || plan.depth_scale == 0.0) return;
  const double half_step = 0.5 / steps_of(plan.depth);
  std::vector<std::uint32_t> lost;
  for (const ShellDraw& draw : pass.draws) {
    if (std::max(draw.depth_at_near, draw.depth_at_far) < half_step) lost.push_back(draw.shell);
  }
  if (lost.empty()) return;
  std::sort(lost.begin(), lost.end());
  planning.warn(fmt::format(
      "depth buffer {}: {} black: under the cue that is less than "
      "half a step of {:.3g}; 32f holds them",
      name(plan.depth), describe_shells(planning.scene, lost), 2.0 * half_step * plan.depth_scale));
}

/// Uncued, the depths of tools share the buffer with the ranks.
void check_tool_depths(Planning& planning, const Pass& pass) {
  const Plan& plan = planning.plan;
  const bool passes = std::any_of(pass.draws.begin(), pass.draws.end(), [](const ShellDraw& draw) {
    return draw.tools == ToolCut::Passes;
  });
  if (!passes || plan.depth_scale > 0.0) return;
  const double steps = plan.depth == DepthFormat::D32F ? 0x1p24 : steps_of(plan.depth);
  const Camera& camera = planning.camera;
  const double depth_mm =
      static_cast<double>(plan.emission_of_rank.size() - 1) * 2.0 * camera.sphere.radius_mm / steps;
  const double at_target = camera.perspective ? camera.eye_distance_mm : 1.0;
  const double pixel_mm =
      2.0 * camera.half_extent * at_target / std::min(camera.size.x, camera.size.y);
  if (depth_mm <= pixel_mm) return;
  planning.warn(
      fmt::format("depth buffer {}: passes tell tools from shells to {:.3g} mm, more than "
                  "a pixel's {:.3g}; 32f or --occlusion texture tells them apart",
                  name(plan.depth), depth_mm, pixel_mm));
}

}  // namespace

void note_limits(Planning& planning) {
  for (const Pass& pass : planning.plan.passes) {
    if (pass.kind == PassKind::Sum || pass.kind == PassKind::Count) {
      if (planning.plan.target == TargetFormat::F16) check_half_floats(planning, pass);
      if (planning.plan.target == TargetFormat::U8) check_bytes(planning, pass);
    }
    if (pass.kind == PassKind::MaxDepth || pass.kind == PassKind::MaxColor) {
      check_steps(planning, pass);
      check_tool_depths(planning, pass);
    }
  }
}

}  // namespace nacre::planning

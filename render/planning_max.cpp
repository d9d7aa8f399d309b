// The maximum projection: which walls, under which remap, in which order, and what the ends of rays
// take.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "core/error.h"
#include "render/planning.h"

namespace nacre::planning {
namespace {

/// Least slope of a cued remap that keeps a tool and a shell behind it apart.
constexpr double kLeastSlope = 0x1p-12;

/// Which way along a ray beta rises.
enum class Trend { TowardsTheEye, None, AwayFromTheEye };

Trend trend_of(const DepthCue& cue) {
  if (is_flat(cue)) return Trend::None;
  return cue.a > 0.0 ? Trend::TowardsTheEye : Trend::AwayFromTheEye;
}

double largest_beta(const DepthCue& cue) { return std::max(beta(cue, 0.0), beta(cue, 1.0)); }

/// Representatives shown, ascending and without repetition; equal ones share a rank, 0 is black.
std::vector<double> representatives(const Planning& planning) {
  std::vector<double> list;
  for (const ShownShell& shell : planning.shells) list.push_back(shell.representative);
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  const DepthFormat depth = planning.options.depth;
  const std::size_t most = depth == DepthFormat::D16 ? (1U << 14U) : (1U << 22U);
  if (list.size() > most) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("depth buffer {}: found {} different shells, expected {} at most",
                            name(depth), list.size(), most));
  }
  return list;
}

Faces faces_needed(const ShownShell& shell, Trend trend) {
  if (trend == Trend::TowardsTheEye) return Faces::Front;
  if (trend == Trend::AwayFromTheEye) return Faces::Back;
  return shell.starts_inside && !shell.ends_inside ? Faces::Back : Faces::Front;
}

/// The remap of a shell whose depth is its rank.
void remap_rank(const std::vector<double>& ranks, double factor, double representative,
                ShellDraw& draw) {
  const auto found = std::lower_bound(ranks.begin(), ranks.end(), representative);
  const auto rank = static_cast<double>(std::distance(ranks.begin(), found) + 1);
  const auto count = static_cast<double>(ranks.size());
  draw.depth_at_near = rank / count;
  // Under tools the depth has to tell near from far: [H96] section 4 as (rank - 1 + z) / count.
  draw.depth_at_far = draw.tools == ToolCut::Passes ? (rank - 1.0) / count : rank / count;
  draw.value_at_near = draw.value_at_far = factor * representative;
}

/// The remap of a shell whose depth is its cued emission, [H96] eqs 3 and 5.
void remap_cue(const DepthCue& cue, double representative, ShellDraw& draw) {
  draw.value_at_near = beta(cue, 1.0) * representative;
  draw.value_at_far = beta(cue, 0.0) * representative;
  draw.depth_at_near = draw.value_at_near / largest_beta(cue);
  draw.depth_at_far = draw.value_at_far / largest_beta(cue);
}

/// Why passes would not be exact, empty if they are.
std::string_view why_not_passes(const Planning& planning) {
  const DepthCue& cue = planning.options.cue;
  if (is_flat(cue)) return "";
  if (cue.a < 0.0) return "the cue falls towards the eye: a shell before a tool has less depth";
  const double slope = cue.a / largest_beta(cue);
  const bool steep =
      std::all_of(planning.shells.begin(), planning.shells.end(), [&](const ShownShell& shell) {
        return !shell.reached || slope * shell.representative >= kLeastSlope;
      });
  return steep ? "" : "the cue is too flat: depths of tools and shells run into each other";
}

/// How tools cut the shells they reach. By texture unless passes are asked for: it is always exact,
/// and seldom the slower (docs/decisions/012-tools-by-texture.md).
ToolCut tool_cut(Planning& planning) {
  const bool reached = std::any_of(planning.shells.begin(), planning.shells.end(),
                                   [](const ShownShell& shell) { return shell.reached; });
  if (!reached || planning.options.occlusion != Occlusion::Passes) return ToolCut::Texture;
  const std::string_view obstacle = why_not_passes(planning);
  if (obstacle.empty()) return ToolCut::Passes;
  planning.leave_out("occlusion by passes", obstacle);
  return ToolCut::Texture;
}

/// The largest emission shown where n of the shells, nested, surround a point.
std::vector<float> emission_of_count(const std::vector<ShownShell>& shells) {
  std::vector<float> emission{0.0F};
  for (const ShownShell& shell : shells) {
    emission.push_back(std::max(emission.back(), static_cast<float>(shell.representative)));
  }
  return emission;
}

void plan_counts(Planning& planning, PassKind kind, const std::vector<ShownShell>& shells) {
  Pass pass{.kind = kind};
  for (const ShownShell& shell : shells) {
    pass.draws.push_back(draw_of(shell, Faces::Both));
    if (kind == PassKind::StartCounts) pass.draws.back().tools = ToolCut::None;
  }
  pass.emission_of_count = emission_of_count(shells);
  planning.plan.passes.push_back(std::move(pass));
}

void plan_start_counts(Planning& planning, Trend trend) {
  const bool all = !planning.options.rules.leave_out_start_counts;
  std::vector<ShownShell> counted;
  bool any_inside = false;
  for (const ShownShell& shell : planning.shells) {
    any_inside |= shell.starts_inside;
    const bool counts =
        trend == Trend::TowardsTheEye || (trend == Trend::None && shell.ends_inside);
    if (all || (counts && shell.starts_inside)) counted.push_back(shell);
  }
  if (!counted.empty()) {
    plan_counts(planning, PassKind::StartCounts, counted);
  } else if (!any_inside) {
    planning.leave_out("counts at the start of rays", "no ray starts inside a shell");
  } else {
    planning.leave_out("counts at the start of rays",
                       trend == Trend::None ? "back faces show the shells that rays start in"
                                            : "the cue is brighter where rays leave or end");
  }
}

void plan_end_counts(Planning& planning, Trend trend) {
  const bool all = !planning.options.rules.leave_out_end_counts;
  std::vector<ShownShell> counted;
  bool any_inside = false;
  for (const ShownShell& shell : planning.shells) {
    any_inside |= shell.ends_inside;
    if (all || (trend == Trend::AwayFromTheEye && shell.ends_inside)) counted.push_back(shell);
  }
  if (!counted.empty()) {
    plan_counts(planning, PassKind::EndCounts, counted);
  } else {
    planning.leave_out(
        "counts at the end of rays",
        any_inside ? "rays are as bright where they start or enter" : "no ray ends inside a shell");
  }
}

void note_max_faces(Planning& planning, const Pass& pass, Trend trend) {
  if (trend == Trend::None) {
    note_faces(planning, pass, "whole shells, the eye outside them: a ray enters through the front",
               "whole shells, the eye perhaps inside: a ray leaves through the back");
  } else {
    note_faces(planning, pass, "the cue is brighter where a ray enters",
               "the cue is brighter where a ray leaves");
  }
}

Pass max_pass(Planning& planning, Trend trend, bool ranked) {
  const RenderOptions& options = planning.options;
  Plan& plan = planning.plan;
  Pass pass;
  if (!planning.tools.empty()) {
    pass.tools = planning.tools;
    pass.tool_triangles = plan.passes.front().tool_triangles;
  }
  const ToolCut cut = tool_cut(planning);
  const bool color = cut == ToolCut::Passes || !options.rules.leave_out_color;
  pass.kind = color ? PassKind::MaxColor : PassKind::MaxDepth;
  const std::vector<double> ranks = ranked ? representatives(planning) : std::vector<double>{};
  for (const ShownShell& shell : planning.shells) {
    pass.draws.push_back(
        draw_of(shell, options.rules.cull_faces ? faces_needed(shell, trend) : Faces::Both));
    ShellDraw& draw = pass.draws.back();
    if (shell.reached) draw.tools = cut;
    ranked ? remap_rank(ranks, beta(options.cue, 0.0), shell.representative, draw)
           : remap_cue(options.cue, shell.representative, draw);
  }
  // Brightest first, so that most of what is covered never passes the depth test; under tools'
  // depths dimmest first, so that none of them hides a brighter shell.
  std::stable_sort(pass.draws.begin(), pass.draws.end(),
                   [color](const ShellDraw& a, const ShellDraw& b) {
                     const auto brightest = [](const ShellDraw& draw) {
                       return std::max(draw.depth_at_near, draw.depth_at_far);
                     };
                     return color ? brightest(a) < brightest(b) : brightest(a) > brightest(b);
                   });
  for (const double representative : ranks) {
    plan.emission_of_rank.push_back(static_cast<float>(beta(options.cue, 0.0) * representative));
  }
  return pass;
}

/// The layers that pixels show, one for each rank; none where a rank is no layer's.
std::vector<LayerRange> layers_of_ranks(const Planning& planning) {
  std::vector<LayerLevel> levels;
  for (const ShellFacts& shell : planning.scene.shells) {
    levels.push_back({shell.emission, shell.representative});
  }
  const std::vector<LayerRange> all = layer_ranges(levels, beta(planning.options.cue, 0.0));
  std::vector<LayerRange> layers;
  for (const float shown : planning.plan.emission_of_rank) {
    const auto layer = std::ranges::find(all, shown, &LayerRange::shown);
    if (layer == all.end()) return {};
    layers.push_back(*layer);
  }
  return layers;
}

/// Rays a pixel along each axis that fine layers take.
constexpr int kFineSamples = 3;
/// The most rays that are taken for them: in larger pictures one a pixel tells as much. Those that
/// end at tools, or start or end within shells, take several times the memory.
constexpr std::int64_t kMostSamples = std::int64_t{1} << 24;
constexpr std::int64_t kMostSamplesWithEnds = std::int64_t{1} << 23;
/// Ranks are numbers of 16 bits at most.
constexpr std::size_t kMostLayers = std::size_t{1} << 16;

/// Says between which levels the picture is estimated, and from how many rays, or why it is not.
void plan_layers(Planning& planning) {
  const RenderOptions& options = planning.options;
  const auto leave_out = [&](std::string_view why) { planning.leave_out("smooth layers", why); };
  if (options.layers == Layers::Flat) return;
  const bool black = planning.plan.passes.empty() || beta(options.cue, 0.0) == 0.0;
  if (black) return leave_out("the picture is black");
  if (!is_flat(options.cue)) return leave_out("under a cue a pixel does not tell its layer");
  if (!options.hidden.empty()) {
    return leave_out("shells are hidden: those shown are to show alone");
  }
  planning.plan.layers = layers_of_ranks(planning);
  if (planning.plan.layers.empty()) return leave_out("a representative lies outside its layer");
  if (planning.plan.layers.size() > kMostLayers) {
    planning.plan.layers.clear();
    return leave_out("there are too many layers to tell apart");
  }
  if (options.layers != Layers::Fine) return;
  const glm::ivec2 size = with_samples(planning.camera, kFineSamples).size;
  const bool has_ends = planning.plan.passes.size() > 1;
  if (std::int64_t{size.x} * size.y > (has_ends ? kMostSamplesWithEnds : kMostSamples)) {
    return planning.leave_out("fine layers", "the picture is large enough without");
  }
  planning.plan.samples = kFineSamples;
}

}  // namespace

void plan_max(Planning& planning) {
  const RenderOptions& options = planning.options;
  const Trend trend = trend_of(options.cue);
  const bool ranked = trend == Trend::None &&
                      (options.rules.leave_out_flat_cue || largest_beta(options.cue) == 0.0);
  if (!planning.shells.empty()) {
    Pass pass = max_pass(planning, trend, ranked);
    planning.plan.depth_scale = ranked ? 0.0 : largest_beta(options.cue);
    note_max_faces(planning, pass, trend);
    const bool color = pass.kind == PassKind::MaxColor;
    planning.plan.passes.push_back(std::move(pass));
    note_occlusion(planning);
    plan_start_counts(planning, trend);
    plan_end_counts(planning, trend);
    if (!color) planning.leave_out("colour target", "the depth is the picture");
  }
  if (ranked) planning.leave_out("depth cue", "a = 0: one factor for all depths");
  plan_layers(planning);
}

}  // namespace nacre::planning

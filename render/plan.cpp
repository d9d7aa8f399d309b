#include "render/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

#include "core/error.h"
#include "render/tiles.h"

namespace nacre {
namespace {

using ShellIndices = std::vector<std::uint32_t>;

/// "2-4, 7" for indices 1, 2, 3, 6.
std::string ranges(const ShellIndices& shells) {
  std::string text;
  for (std::size_t first = 0; first < shells.size();) {
    std::size_t last = first;
    while (last + 1 < shells.size() && shells[last + 1] == shells[last] + 1) ++last;
    if (!text.empty()) text += ", ";
    text += first == last ? fmt::format("{}", shells[first] + 1)
                          : fmt::format("{}-{}", shells[first] + 1, shells[last] + 1);
    first = last + 1;
  }
  return text;
}

std::string describe_shells(const SceneFacts& scene, const ShellIndices& shells) {
  std::size_t triangles = 0;
  for (const std::uint32_t shell : shells) triangles += scene.shells[shell].triangles;
  return fmt::format("shell{} {} ({} triangles)", shells.size() == 1 ? "" : "s", ranges(shells),
                     triangles);
}

/// Takes the shells for which the rule holds out of `shown`, and says so.
void leave_out_if(const SceneFacts& scene, std::string_view why,
                  const std::function<bool(std::uint32_t)>& rule, ShellIndices& shown,
                  std::vector<LeftOut>& left_out) {
  const auto kept_end = std::stable_partition(shown.begin(), shown.end(), std::not_fn(rule));
  const ShellIndices gone(kept_end, shown.end());
  shown.erase(kept_end, shown.end());
  if (!gone.empty()) left_out.push_back({describe_shells(scene, gone), std::string(why)});
}

/// Shells that can show, outermost first.
ShellIndices shown_shells(const SceneFacts& scene, const Camera& camera,
                          const RenderOptions& options, std::vector<LeftOut>& left_out) {
  ShellIndices shown(scene.shells.size());
  for (std::size_t i = 0; i < shown.size(); ++i) shown[i] = static_cast<std::uint32_t>(i);
  const auto leave_out = [&](std::string_view why, const std::function<bool(std::uint32_t)>& rule) {
    leave_out_if(scene, why, rule, shown, left_out);
  };
  leave_out("hidden: the layer shows the previous shown shell", [&](std::uint32_t i) {
    return std::find(options.hidden.begin(), options.hidden.end(), i) != options.hidden.end();
  });
  if (options.rules.leave_out_empty) {
    leave_out("empty: nothing reaches the level",
              [&](std::uint32_t i) { return scene.shells[i].triangles == 0; });
  }
  if (options.rules.leave_out_dark) {
    leave_out("dark: the emission shown is 0",
              [&](std::uint32_t i) { return scene.shells[i].representative <= 0.0; });
  }
  if (options.rules.leave_out_outside_view) {
    leave_out("outside the view", [&](std::uint32_t i) {
      const ShellFacts& shell = scene.shells[i];
      return shell.triangles > 0 && outside_view(camera, scene.center_mm, shell.bounds);
    });
  }
  return shown;
}

void check(const SceneFacts& scene, const RenderOptions& options) {
  for (const std::uint32_t shell : options.hidden) {
    if (shell >= scene.shells.size()) {
      throw Error(ErrorCode::BadArgument, fmt::format("hidden shell: found {}, expected 1 to {}",
                                                      shell + 1, scene.shells.size()));
    }
  }
  check_cue(options.cue);
  if (options.mode != PictureMode::Max) {
    throw Error(ErrorCode::Unsupported,
                "picture mode: this renderer draws the maximum projection only");
  }
  if (!is_flat(options.cue)) {
    throw Error(
        ErrorCode::Unsupported,
        fmt::format("depth cue: found a = {}, this renderer draws a = 0 only", options.cue.a));
  }
  if (std::isfinite(options.slab.near_mm) || std::isfinite(options.slab.far_mm)) {
    throw Error(ErrorCode::Unsupported, "slab: this renderer draws whole volumes only");
  }
}

/// Ranks of the representatives shown: equal ones share a rank, 0 is black.
struct Ranks {
  std::vector<double> representatives;  ///< ascending, without repetition

  std::size_t of(double representative) const {
    const auto found =
        std::lower_bound(representatives.begin(), representatives.end(), representative);
    return static_cast<std::size_t>(found - representatives.begin()) + 1;
  }
};

Ranks rank_shells(const SceneFacts& scene, const ShellIndices& shown, DepthFormat depth) {
  Ranks ranks;
  for (const std::uint32_t i : shown) {
    ranks.representatives.push_back(scene.shells[i].representative);
  }
  std::sort(ranks.representatives.begin(), ranks.representatives.end());
  const auto repeated = std::unique(ranks.representatives.begin(), ranks.representatives.end());
  ranks.representatives.erase(repeated, ranks.representatives.end());

  const std::size_t most = depth == DepthFormat::D16 ? (1U << 14U) : (1U << 22U);
  if (ranks.representatives.size() > most) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("depth buffer {}: found {} different shells, expected {} at most",
                            name(depth), ranks.representatives.size(), most));
  }
  return ranks;
}

Faces faces_needed(const SceneFacts& scene, const Camera& camera, std::uint32_t shell) {
  const ShellFacts& facts = scene.shells[shell];
  return beyond_near_plane(camera, scene.center_mm, facts.bounds) ? Faces::Front : Faces::Back;
}

/// The pass that writes ranks, brightest first so that most of what is covered never passes the
/// depth test.
Pass max_depth_pass(const SceneFacts& scene, const Camera& camera, const RenderOptions& options,
                    const ShellIndices& shown, const Ranks& ranks) {
  Pass pass;
  for (const std::uint32_t i : shown) {
    const double depth = static_cast<double>(ranks.of(scene.shells[i].representative)) /
                         static_cast<double>(ranks.representatives.size());
    const Faces faces = options.rules.cull_faces ? faces_needed(scene, camera, i) : Faces::Both;
    pass.draws.push_back({i, scene.shells[i].triangles, faces, depth, depth});
  }
  std::stable_sort(
      pass.draws.begin(), pass.draws.end(),
      [](const ShellDraw& a, const ShellDraw& b) { return a.depth_at_near > b.depth_at_near; });
  return pass;
}

void note_faces(const SceneFacts& scene, const Pass& pass, std::vector<LeftOut>& left_out) {
  for (const Faces faces : {Faces::Front, Faces::Back}) {
    ShellIndices shells;
    for (const ShellDraw& draw : pass.draws) {
      if (draw.faces == faces) shells.push_back(draw.shell);
    }
    if (shells.empty()) continue;
    std::sort(shells.begin(), shells.end());
    const std::string of_shells = describe_shells(scene, shells);
    if (faces == Faces::Front) {
      left_out.push_back({"back faces of " + of_shells,
                          "whole shells, the eye outside them: a ray enters through the front"});
    } else {
      left_out.push_back({"front faces of " + of_shells,
                          "whole shells, the eye perhaps inside: a ray leaves through the back"});
    }
  }
}

}  // namespace

std::string describe(const Pass& pass) {
  std::size_t triangles = 0;
  for (const ShellDraw& draw : pass.draws) triangles += draw.triangles;
  return fmt::format("max as depth: {} shell{}, {} triangles", pass.draws.size(),
                     pass.draws.size() == 1 ? "" : "s", triangles);
}

std::vector<std::uint32_t> shells_drawn(const Plan& plan) {
  ShellIndices shells;
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
  Plan plan;
  plan.depth = options.depth;
  plan.tiles = tiles(camera.size, capabilities.max_target_side);

  const ShellIndices shown = shown_shells(scene, camera, options, plan.left_out);
  const Ranks ranks = rank_shells(scene, shown, options.depth);
  const double factor = beta(options.cue, 0.0);
  for (const double representative : ranks.representatives) {
    plan.emission_of_rank.push_back(static_cast<float>(factor * representative));
  }
  if (!shown.empty()) {
    plan.passes.push_back(max_depth_pass(scene, camera, options, shown, ranks));
    note_faces(scene, plan.passes.back(), plan.left_out);
  }
  plan.left_out.push_back({"depth cue", "a = 0: one factor for all depths"});
  plan.left_out.push_back({"colour target", "the depth is the picture"});
  plan.left_out.push_back({"normals", "nothing is lit"});
  return plan;
}

}  // namespace nacre

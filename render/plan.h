#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/camera.h"
#include "render/projection.h"
#include "render/render_options.h"
#include "render/scene_facts.h"

namespace nacre {

/// What a machine can do, as far as plans depend on it.
struct Capabilities {
  int max_target_side = 4096;  ///< pixels; larger pictures are drawn in tiles
};

/// Something the plan does without, and why the picture is the same.
struct LeftOut {
  std::string what;  ///< "shells 2-4, 7 (1200 triangles)"; shells count from 1, outermost first
  std::string why;   ///< "hidden"
};

/// Which walls of a closed shell are drawn: those whose outside faces the eye, the others, or all.
enum class Faces { Front, Back, Both };

/// One shell drawn under its own depth remap, [H96] eqs 3 and 5: after projection and division its
/// depth goes linearly from `depth_at_near` (depth z = 1) to `depth_at_far` (z = 0).
///
/// Both are in [0, 1]; the greatest depth wins. For an uncued maximum both are the shell's rank
/// over the number of ranks: the depth is a constant.
struct ShellDraw {
  std::uint32_t shell = 0;  ///< index into the scene's shells, from 0
  std::size_t triangles = 0;
  Faces faces = Faces::Front;
  double depth_at_near = 0.0;
  double depth_at_far = 0.0;
};

enum class PassKind {
  MaxDepth,  ///< shells into a depth buffer cleared to 0, the greatest depth wins; no colour
};

/// A sweep over shells that share their target and state.
struct Pass {
  PassKind kind = PassKind::MaxDepth;
  std::vector<ShellDraw> draws;  ///< in drawing order
};

/// "max as depth: 48 shells, 1200345 triangles".
std::string describe(const Pass& pass);

/// All that drawing a picture takes, and what it does without.
struct Plan {
  std::vector<Pass> passes;       ///< none for a picture that is black anyway
  std::vector<LeftOut> left_out;  ///< in the order the rules were tried
  std::vector<PixelRect> tiles;   ///< the passes are run on each; they cover the picture
  DepthFormat depth = DepthFormat::D32F;
  /// The emission that a rank stands for, [0] = 0 for black: a depth d read back is rank
  /// round(d * (size - 1)).
  std::vector<float> emission_of_rank{0.0F};
};

/// Indices of the shells that the plan draws, ascending: what has to be decoded and uploaded.
std::vector<std::uint32_t> shells_drawn(const Plan& plan);

/// Plans a picture: a pure function, needs no GL and no decoded shell.
///
/// For the maximum projection ([H96] eq. 4) without a cue it lists one pass that writes for each
/// shell the rank of its representative, brightest first. Left out, each only where the picture
/// stays what it is:
///
/// - shells that are hidden (their layer shows the previous shown shell, which surrounds it), have
///   no triangles, shine with 0, or lie outside the view;
/// - one wall of each shell: a ray that meets a closed shell meets its front (entering) if the eye
///   is outside, so front faces suffice for a shell that lies beyond the near plane; wherever the
///   eye is, the ray leaves the shell through its back, so for the others back faces do. Without a
///   cue, tools and slabs both show the same;
/// - the cue when a = 0: beta is then one factor, applied to the emission of each rank.
///
/// @throws Error  BadArgument for a hidden shell that does not exist, or a cue that is not finite
///                or negative at z = 0 or 1; Unsupported for what this renderer does not draw
///                (modes other than Max, cues with a != 0, slabs) and for more representatives than
///                the depth format keeps apart (a quarter of its steps)
Plan make_plan(const SceneFacts& scene, const Camera& camera, const RenderOptions& options,
               const Capabilities& capabilities = {});

}  // namespace nacre

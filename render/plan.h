#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/dequantization.h"
#include "core/volume_silhouette.h"
#include "render/projection.h"
#include "render/ray_frame.h"
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

/// How tools cut a shell.
enum class ToolCut {
  None,     ///< no tool reaches it
  Texture,  ///< what lies beyond the tool layer's depth is cut in the fragment stage
  Passes,   ///< the tools are drawn before the shell under its remap, [H96] section 4
};

/// One shell drawn.
///
/// For a maximum it has its own depth remap, [H96] eqs 3 and 5: its depth goes linearly from
/// `depth_at_near` (depth z = 1) to `depth_at_far` (z = 0), both in [0, 1], and the greatest depth
/// wins. For an uncued maximum both are the shell's rank over the number of ranks: a constant.
struct ShellDraw {
  std::uint32_t shell = 0;  ///< index into the scene's shells, from 0
  std::size_t triangles = 0;
  Faces faces = Faces::Both;
  bool cut_by_slab = false;  ///< part of its bounds lies outside the slab
  ToolCut tools = ToolCut::None;
  double depth_at_near = 0.0;
  double depth_at_far = 0.0;
  double value_at_near = 0.0;  ///< the brightness written where there is a colour target as well
  double value_at_far = 0.0;
  double weight = 0.0;  ///< what a crossing adds: r_k minus the previous shown (sum), r_k (count)
};

enum class PassKind {
  ToolLayer,    ///< colours and depths of the tools, the nearest winning
  MaxDepth,     ///< shells into a depth buffer cleared to 0, the greatest depth wins; no colour
  MaxColor,     ///< the same with the brightness in a colour target, dimmest shell first
  StartCounts,  ///< how many shells contain the start of each ray: back minus front faces beyond it
  EndCounts,    ///< the same for the end of each ray
  Sum,          ///< signed crossings of the cue's antiderivative, added up
  Count,        ///< crossings add their shell's brightness
  Lit,          ///< lit shells, the nearest winning
};

/// A sweep over shells or tools that share their target and state.
struct Pass {
  PassKind kind = PassKind::MaxDepth;
  std::vector<ShellDraw> draws = {};          ///< in drawing order
  std::vector<std::uint32_t> tools = {};      ///< indices of the tools drawn
  std::size_t tool_triangles = 0;             ///< of those tools, together
  Interval depths_mm = {};                    ///< view depths of what is drawn (ToolLayer, Lit)
  std::vector<float> emission_of_count = {};  ///< Start- and EndCounts: [n] for n shells, [0] = 0
};

/// Triangles that the pass sends: tools before each shell they are drawn for, and shells.
std::size_t triangles(const Pass& pass);

/// "max as depth: 48 shells, 1200345 triangles".
std::string describe(const Pass& pass);

/// All that drawing a picture takes, and what it does without.
struct Plan {
  std::vector<Pass> passes;       ///< none for a picture that is black anyway
  std::vector<LeftOut> left_out;  ///< in the order the rules were tried
  /// What the chosen formats do not hold of this scene, each in a sentence: brightness that ends or
  /// is lost in a target or depth buffer of few bits.
  std::vector<std::string> warnings;
  std::vector<PixelRect> tiles;  ///< the passes are run on each; they cover the picture
  DepthFormat depth = DepthFormat::D32F;
  TargetFormat target = TargetFormat::F32;
  RaySpan rays;  ///< where rays start and end
  DepthCue cue;
  bool normals = false;    ///< whether the shells have to be uploaded with normals
  double depth_scale = 0;  ///< brightness of depth 1 in a cued maximum; 0 where depths are ranks
  /// The emission that a rank stands for, [0] = 0 for black: a depth d read back is rank
  /// round(d * (size - 1)).
  std::vector<float> emission_of_rank{0.0F};
  /// Between which a maximum is estimated once it is drawn, one for each rank; empty: it stays as
  /// it is.
  std::vector<LayerRange> layers;
  /// Rays a pixel along each axis, from which that is estimated. What is drawn, `tiles` and
  /// `columns` with it, is so many times as large as the picture.
  int samples = 1;
  /// The columns of each row whose rays meet the volume's box: the others are black, whatever was
  /// drawn. Empty: all columns show.
  std::vector<PixelSpan> columns;
};

/// What a maximum shows between the levels.
inline Layers layers_drawn(const Plan& plan) {
  if (plan.layers.empty()) return Layers::Flat;
  return plan.samples > 1 ? Layers::Fine : Layers::Smooth;
}

/// Indices of the shells that the plan draws, ascending: what has to be decoded and uploaded.
std::vector<std::uint32_t> shells_drawn(const Plan& plan);

/// Plans a picture: a pure function, needs no GL and no decoded shell.
///
/// Along each ray shows what lies between its start (the slab's near plane; the eye's) and its end
/// (the slab's far plane, the nearest tool).
///
/// - **max** ([H96] eq. 4): one pass that keeps the greatest beta(z) r over the crossings between
///   start and end. Where rays can start or end inside shells, a pass counts the shells around that
///   end: n of them mean emission r_n there.
/// - **sum** ([H96] eq. 2): all crossings, clamped to start and end, add up.
/// - **count**: all crossings between start and end add r_k.
/// - **iso**: the nearest crossing between start and end, lit.
///
/// A ray that misses the box of the volume, where one is stated, shows nothing but for iso: caps
/// lie on their grid, up to about a step beyond the box (docs/decisions/028-exact-borders.md).
///
/// Left out, each only where the picture stays what it is (`PlanRules` has a switch for each):
///
/// - shells that are hidden (their layer shows the previous shown shell, which surrounds it), have
///   no triangles, add nothing, lie outside the view or outside the slab; lit shells within
///   another;
/// - one wall of each shell. Max, beta rising towards the eye: fronts are nearer than backs, and a
///   ray that starts inside is brightest at its start. Falling: backs, and the end. Flat: each ray
///   that meets a shell meets its front, unless it starts inside; it meets its back, unless it ends
///   inside. Lit: fronts, unless rays can start inside;
/// - the cue when a = 0: beta is then one factor, applied to the emission of each rank;
/// - tools outside the view, and tools against shells whose bounds they do not reach;
/// - counts where no ray can start (end) inside a shell, or where the other end is brighter;
/// - the colour target where the depth is the picture; normals where nothing is lit.
///
/// Tools against a maximum: by texture or, if asked for, by passes, see `Occlusion`. Passes need
/// depths that rise towards the eye: they are exact without a cue, and with one where
/// a r_k / beta_max >= 2^-12 for each shell that tools reach; elsewhere the texture is used, and
/// said to be. In 16 bits, shared among all remaps without a cue, they tell a tool from a shell to
/// n / 2^16 of the sphere's diameter.
///
/// @throws Error  BadArgument for a hidden shell that does not exist, a cue that is not finite or
///                negative at z = 0 or 1, an empty slab, or a sum in 8 bits; Unsupported for more
///                representatives than the depth format keeps apart (a quarter of its steps)
Plan make_plan(const SceneFacts& scene, const Camera& camera, const RenderOptions& options,
               const Capabilities& capabilities = {});

}  // namespace nacre

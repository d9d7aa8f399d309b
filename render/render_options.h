#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/picture.h"

namespace nacre {

/// Format of the depth buffer, `--depth-buffer`. It holds ranks for an uncued maximum, which all
/// three keep exactly. A cued maximum is rounded to a step of 2^-16 (D16) or 2^-24 (D24) of
/// beta_max, or to a float's 2^-24 of itself (D32F). Lit shells are told apart to that part of
/// their range of depths.
enum class DepthFormat { D16, D24, D32F };

/// Format of the colour target that crossings are added up in or lit shells drawn to, `--target`.
///
/// - F32: rounding of a float per crossing, about 1e-7 of the largest term;
/// - F16: 2^-11 of the partial sum per crossing, and nothing above 65504;
/// - U8: steps of 1/255, and all above 1 is 1, as [H96] had it. Not for sums: emission * mm has
///   negative terms and does not end at 1.
enum class TargetFormat { U8, F16, F32 };

/// How tools hide what is behind them in a maximum projection, `--occlusion`.
///
/// - Passes: [H96] section 4, the tools' depth under each shell's remap, dimmest shell first;
/// - Texture: the tools' depth once, compared for each fragment;
/// - Auto: the texture, always exact and seldom the slower (decision 012).
enum class Occlusion { Auto, Passes, Texture };

/// What a maximum shows between the levels, `--layers`.
///
/// - Flat: each layer its representative;
/// - Smooth: an estimate from the layers of the pixels around (`dequantize`);
/// - Fine: the same from three by three rays a pixel, which tell better where layers begin.
enum class Layers { Flat, Smooth, Fine };

/// "16", "24", "32f", as `--depth-buffer` has them.
std::string_view name(DepthFormat format) noexcept;
/// "8", "16f", "32f", as `--target` has them.
std::string_view name(TargetFormat format) noexcept;
/// "auto", "passes", "texture".
std::string_view name(Occlusion occlusion) noexcept;
/// "flat", "smooth", "fine".
std::string_view name(Layers layers) noexcept;

/// What has that name, if anything does.
std::optional<DepthFormat> depth_format(std::string_view name) noexcept;
std::optional<TargetFormat> target_format(std::string_view name) noexcept;
std::optional<Occlusion> occlusion(std::string_view name) noexcept;
std::optional<Layers> layers(std::string_view name) noexcept;

/// What the plan may leave out though it is there. All on but for tests, which show that switching
/// a rule off changes the work and not the picture.
struct PlanRules {
  bool leave_out_empty = true;         ///< shells without triangles
  bool leave_out_dark = true;          ///< shells that add nothing to what is shown around them
  bool leave_out_outside_view = true;  ///< shells and tools whose bounds no ray meets
  bool leave_out_outside_slab = true;  ///< shells whose bounds the slab does not meet
  bool leave_out_enclosed = true;      ///< lit shells within another, which hides them
  bool cull_faces = true;              ///< one wall of each shell, where the other one suffices
  bool leave_out_flat_cue = true;      ///< a cue of a = 0, which is one factor
  bool limit_occlusion = true;         ///< tools against shells that they cannot hide
  bool leave_out_start_counts = true;  ///< counting the shells around the start of rays
  bool leave_out_end_counts = true;    ///< counting the shells around the end of rays
  bool leave_out_color = true;         ///< a colour target where the depth is the picture
  bool leave_out_normals = true;       ///< normals where nothing is lit
};

/// What to show of a scene, and how.
struct RenderOptions {
  PictureMode mode = PictureMode::Max;
  DepthCue cue = {};
  Slab slab = {};
  std::vector<std::uint32_t> hidden = {};  ///< indices into the set's shells, from 0; any order
  DepthFormat depth = DepthFormat::D32F;
  TargetFormat target = TargetFormat::F32;
  Occlusion occlusion = Occlusion::Auto;
  Layers layers = Layers::Flat;
  PlanRules rules = {};
};

}  // namespace nacre

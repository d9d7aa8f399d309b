#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/picture.h"

namespace nacre {

/// Format of the depth buffer. It holds ranks for an uncued maximum, which all three keep exactly.
enum class DepthFormat { D16, D24, D32F };

/// "16", "24", "32f", as `--depth-buffer` has them.
std::string_view name(DepthFormat format) noexcept;

/// The format of that name, if there is one.
std::optional<DepthFormat> depth_format(std::string_view name) noexcept;

/// What the plan may leave out though it is there. All on but for tests, which show that switching
/// a rule off changes the work and not the picture.
struct PlanRules {
  bool leave_out_empty = true;         ///< shells without triangles
  bool leave_out_dark = true;          ///< shells whose representative is 0
  bool leave_out_outside_view = true;  ///< shells whose bounds no ray meets
  bool cull_faces = true;              ///< one wall of each shell, where the other one suffices
};

/// What to show of a scene, and how.
struct RenderOptions {
  PictureMode mode = PictureMode::Max;
  DepthCue cue = {};
  Slab slab = {};
  std::vector<std::uint32_t> hidden = {};  ///< indices into the set's shells, from 0; any order
  DepthFormat depth = DepthFormat::D32F;
  PlanRules rules = {};
};

}  // namespace nacre

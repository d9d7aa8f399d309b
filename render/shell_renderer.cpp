#include "render/shell_renderer.h"

#include <fmt/core.h>

#include "core/error.h"

namespace nacre {

void finish_picture(const Plan& plan, Picture& picture, std::vector<float>& memory,
                    const RowLoop& rows) {
  black_outside(plan.columns, picture.volume);
  if (plan.layers.empty()) return;
  std::span<const std::uint8_t> fixed;
  if (picture.tools) fixed = picture.tools->covered;
  dequantize(picture.volume, plan.layers, fixed, rows, memory);
  // The background beside a cut vessel is estimated to be lit, too.
  black_outside(plan.columns, picture.volume);
}

void check_upload(const ShellSet& set, const SceneFacts& facts,
                  std::span<const std::uint32_t> shells) {
  for (const std::uint32_t shell : shells) {
    if (shell >= set.shells.size() || shell >= facts.shells.size()) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("shell {}: found {} in the set", shell + 1, set.shells.size()));
    }
    const std::size_t found = set.shells[shell].surface.triangles.size();
    if (found != facts.shells[shell].triangles) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("shell {}: found {} triangles, expected {}", shell + 1, found,
                              facts.shells[shell].triangles));
    }
  }
}

}  // namespace nacre

#include "render/shell_renderer.h"

#include <fmt/core.h>

#include <utility>

#include "core/error.h"

namespace nacre {

Image blank_samples(const Camera& camera, const Plan& plan, PictureMemory& memory) {
  const glm::ivec2 size = with_samples(camera, plan.samples).size;
  if (plan.layers.empty()) return make_image(size.x, size.y);
  Image image = std::move(memory.samples);
  image.width = size.x;
  image.height = size.y;
  image.pixels.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), 0.0F);
  return image;
}

void finish_picture(const Plan& plan, Picture& picture, PictureMemory& memory,
                    const RowLoop& rows) {
  black_outside(plan.columns, picture.volume);
  if (plan.layers.empty()) return;
  std::span<const std::uint8_t> fixed;
  if (picture.tools) fixed = picture.tools->covered;
  memory.samples = std::exchange(picture.volume, {});
  dequantize(memory.samples, plan.samples, plan.layers, fixed, rows, memory.layers, picture.volume);
  // The background beside a cut vessel is estimated to be lit, too.
  black_outside(middle_spans(plan.columns, plan.samples), picture.volume);
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

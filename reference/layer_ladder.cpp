#include "reference/layer_ladder.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace nacre {
namespace {

void check(std::span<const ShownLevel> levels) {
  if (levels.empty()) {
    throw Error(ErrorCode::BadArgument, "levels: found none, expected at least one");
  }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const auto& [value, representative] = levels[i];
    if (!std::isfinite(value) || (i > 0 && value < levels[i - 1].value)) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("levels: found the value {} at place {}, expected finite values that "
                              "ascend",
                              value, i + 1));
    }
    if (!(representative >= 0.0 && representative <= 1.0)) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("levels: found the representative {} at place {}, expected 0 to 1",
                              representative, i + 1));
    }
  }
}

}  // namespace

LayerLadder::LayerLadder(const WalkField& field, std::span<const ShownLevel> levels)
    : shown{0.0}, brightest{0.0} {
  check(levels);
  for (const auto& [value, representative] : levels) {
    values.push_back(field.field_of(value));
    shown.push_back(representative);
    brightest.push_back(std::max(brightest.back(), representative));
  }
  for (std::size_t brick = 0; brick < field.bricks.least.size(); ++brick) {
    least_layer.push_back(static_cast<std::uint32_t>(reached(field.bricks.least[brick])));
    greatest_layer.push_back(static_cast<std::uint32_t>(reached(field.bricks.greatest[brick])));
  }
}

std::size_t LayerLadder::reached(double value, std::size_t lo, std::size_t hi) const {
  const auto begin = values.begin();
  return static_cast<std::size_t>(std::upper_bound(begin + static_cast<std::ptrdiff_t>(lo),
                                                   begin + static_cast<std::ptrdiff_t>(hi), value) -
                                  begin);
}

}  // namespace nacre

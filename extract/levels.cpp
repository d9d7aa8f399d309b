#include "extract/levels.h"

#include <fmt/core.h>

#include "core/error.h"

namespace nacre {

std::vector<Level> uniform_levels(std::size_t count) {
  if (count < 1) throw Error(ErrorCode::BadArgument, "levels: found 0, expected at least 1");
  std::vector<Level> levels(count);
  const auto n = static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto k = static_cast<double>(i + 1);
    levels[i] = {.emission = (k - 0.5) / n, .representative = k / n};
  }
  return levels;
}

std::vector<Level> explicit_levels(std::span<const double> emissions) {
  if (emissions.empty()) throw Error(ErrorCode::BadArgument, "levels: found none");
  std::vector<Level> levels(emissions.size());
  for (std::size_t i = 0; i < emissions.size(); ++i) {
    const double t = emissions[i];
    if (!(t > 0.0 && t <= 1.0) || (i > 0 && !(t > emissions[i - 1]))) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("level {}: found emission {}, expected ascending ones above 0 and at "
                              "most 1",
                              i + 1, t));
    }
    const bool last = i + 1 == emissions.size();
    levels[i] = {.emission = t, .representative = last ? 1.0 : 0.5 * (t + emissions[i + 1])};
  }
  return levels;
}

}  // namespace nacre

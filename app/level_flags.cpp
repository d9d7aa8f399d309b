#include "app/level_flags.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "app/flag_values.h"
#include "core/error.h"

namespace nacre {
namespace {

/// "24" is a count; "0.2", "1" with other numbers and anything with a comma or a point are
/// emissions.
bool is_count(const std::string& text) {
  return text.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

void add_level_flags(CLI::App& verb, LevelFlags& flags) {
  const std::string group = "Shells";
  auto* levels = verb.add_option("--levels", flags.levels,
                                 "N levels, or emissions t1,t2,... from above 0 to 1 (default: 24; "
                                 "for an exact iso picture 0.5)")
                     ->group(group);
  verb.add_option("--level-values", flags.level_values, "v1,v2,... in the volume's values")
      ->excludes(levels)
      ->group(group);
  verb.add_option("--placement", flags.placement,
                  "Where N levels are put: for the least error of maximum projections over "
                  "directions (optimal), evenly, or optimal where that gains more than 1 dB (auto)")
      ->check(CLI::IsMember({"auto", "optimal", "uniform"}))
      ->capture_default_str()
      ->group(group);
}

bool are_placed(const LevelFlags& flags) {
  return flags.level_values.empty() && is_count(flags.levels);
}

std::vector<Level> levels_of(const LevelFlags& flags, const EmissionMap& emission,
                             const std::string& otherwise) {
  if (!flags.level_values.empty()) {
    std::vector<double> emissions =
        parse_numbers("--level-values", flags.level_values, 0, "v1,v2,... in the volume's values");
    for (double& value : emissions) {
      if (!std::isfinite(value)) {
        throw Error(ErrorCode::BadArgument,
                    fmt::format("--level-values: found {}, expected finite values", value));
      }
      value = emission(value);
    }
    return explicit_levels(emissions);
  }
  const std::string& text = flags.levels.empty() ? otherwise : flags.levels;
  if (!is_count(text)) {
    return explicit_levels(parse_numbers("--levels", text, 0, "N or t1,t2,..."));
  }
  constexpr long long kMostLevels = 1000;
  const long long count = parse_integers("--levels", text, 1, "N or t1,t2,...").front();
  if (count < 1 || count > kMostLevels) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("--levels: found {}, expected 1 to {}", count, kMostLevels));
  }
  return uniform_levels(static_cast<std::size_t>(count));
}

}  // namespace nacre

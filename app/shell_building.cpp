#include "app/shell_building.h"

#include <fmt/core.h>

#include <charconv>
#include <vector>

#include "app/flag_values.h"
#include "core/error.h"
#include "extract/levels.h"
#include "shells/build.h"

namespace nacre {
namespace {

/// "24" is a count; "0.2", "1" with other numbers and anything with a comma or a point are
/// emissions.
bool is_count(const std::string& text) {
  return text.find_first_not_of("0123456789") == std::string::npos;
}

std::vector<Level> levels_of(const ShellFlags& flags, const EmissionMap& emission) {
  if (!flags.level_values.empty()) {
    std::vector<double> emissions =
        parse_numbers("--level-values", flags.level_values, 0, "v1,v2,... in the volume's values");
    for (double& value : emissions) value = emission(value);
    return explicit_levels(emissions);
  }
  if (!is_count(flags.levels)) {
    return explicit_levels(parse_numbers("--levels", flags.levels, 0, "N or t1,t2,..."));
  }
  constexpr long long kMostLevels = 1000;
  const long long count = parse_integers("--levels", flags.levels, 1, "N or t1,t2,...").front();
  if (count < 1 || count > kMostLevels) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("--levels: found {}, expected 1 to {}", count, kMostLevels));
  }
  return uniform_levels(static_cast<std::size_t>(count));
}

}  // namespace

ShellSet build_shell_set(const ShellFlags& flags, EmissionVolume input, Reporter& reporter,
                         BuildFigures& figures) {
  BuildOptions options;
  options.levels = levels_of(flags, input.emission);
  options.placement = is_count(flags.levels) && flags.level_values.empty() ? "uniform" : "explicit";
  options.emission_tolerance = flags.tolerance;
  options.tolerance_mm = flags.tolerance_mm;
  options.quantization_bits = flags.quantization;
  options.progress = reporter.progress();
  BuiltShells built = build_shells(std::move(input.volume), input.emission, options);
  if (built.report.is_grid_coarse) {
    reporter.warn(
        fmt::format("the quantisation step is {:.3g} of the smallest spacing, more than "
                    "1/64: more bits would be needed",
                    built.report.step_spacings));
  }
  figures.extract = built.report.extract_seconds;
  figures.simplify = built.report.simplify_seconds + built.report.snap_seconds;
  figures.extracted_triangles = built.report.extracted_triangles;
  return std::move(built.set);
}

}  // namespace nacre

#include "app/shell_building.h"

#include <fmt/core.h>

#include <cmath>
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
    for (double& value : emissions) {
      if (!std::isfinite(value)) {
        throw Error(ErrorCode::BadArgument,
                    fmt::format("--level-values: found {}, expected finite values", value));
      }
      value = emission(value);
    }
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

BuildOptions options_of(const ShellFlags& flags, const EmissionMap& emission, Reporter& reporter) {
  BuildOptions options;
  options.levels = levels_of(flags, emission);
  options.placement = is_count(flags.levels) && flags.level_values.empty() ? "uniform" : "explicit";
  options.emission_tolerance = flags.tolerance;
  options.tolerance_mm = flags.tolerance_mm;
  options.quantization_bits = flags.quantization;
  options.progress = reporter.progress();
  return options;
}

void tell(const BuildReport& report, Reporter& reporter, BuildFigures& figures) {
  if (report.is_grid_coarse) {
    reporter.warn(
        fmt::format("the quantisation step is {:.3g} of the smallest spacing, more than "
                    "1/64: more bits would be needed",
                    report.step_spacings));
  }
  figures.extract = report.extract_seconds;
  figures.simplify = report.simplify_seconds + report.snap_seconds;
  figures.encode = report.sink_seconds;
  figures.extracted_triangles = report.extracted_triangles;
}

}  // namespace

ShellSet build_shell_set(const ShellFlags& flags, EmissionVolume input, Reporter& reporter,
                         BuildFigures& figures) {
  const BuildOptions options = options_of(flags, input.emission, reporter);
  BuiltShells built = build_shells(std::move(input.volume), input.emission, options);
  tell(built.report, reporter, figures);
  return std::move(built.set);
}

CompressedSet build_compressed_set(const ShellFlags& flags, EmissionVolume input,
                                   const std::filesystem::path& scratch_folder, Reporter& reporter,
                                   BuildFigures& figures) {
  BuildOptions options = options_of(flags, input.emission, reporter);
  options.scratch_folder = scratch_folder;
  release_free_memory();
  CompressedSet result;
  result.shells.resize(options.levels.size());
  BuiltShells built = build_shells(std::move(input.volume), input.emission, options,
                                   [&](const ShellSet& set, std::size_t k, TriangleMesh&& surface) {
                                     result.shells[k] =
                                         compress_shell(std::move(surface), *set.grid);
                                     release_free_memory();
                                   });
  tell(built.report, reporter, figures);
  result.set = std::move(built.set);
  return result;
}

}  // namespace nacre

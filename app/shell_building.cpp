#include "app/shell_building.h"

#include <fmt/core.h>

#include <vector>

#include "shells/build.h"

namespace nacre {
namespace {

BuildOptions options_of(const ShellFlags& flags, const EmissionMap& emission, Reporter& reporter) {
  BuildOptions options;
  options.levels = levels_of(flags, emission);
  options.placement = are_placed(flags) ? "uniform" : "explicit";
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

#include "app/shell_building.h"

#include <fmt/core.h>

#include <utility>
#include <vector>

#include "app/build_words.h"
#include "app/level_placement.h"
#include "io/draco_decode.h"
#include "shells/build.h"
#include "shells/crossings.h"
#include "shells/prune.h"

namespace nacre {
namespace {

// Draco's effort where its time counts and the bytes only pass through memory.
constexpr int kQuickCompression = 1;

BuildOptions options_of(const ShellFlags& flags, const EmissionVolume& input, PlacedLevels placed) {
  BuildOptions options;
  options.levels = std::move(placed.levels);
  options.placement = std::move(placed.placement);
  options.emission_tolerance = flags.tolerance;
  options.tolerance_mm = flags.tolerance_mm;
  options.quantization_bits = flags.quantization;
  if (!flags.keep_specks) {
    options.min_component_mm3 =
        flags.min_component.value_or(default_speck_mm3(input.volume.world_from_voxel));
  }
  options.prune_inner = flags.purpose == "max";
  return options;
}

BuildOptions options_of(const ShellFlags& flags, const EmissionVolume& input, Reporter& reporter,
                        BuildFigures& figures) {
  Stopwatch placing;
  PlacedLevels placed = place_levels(flags, input, reporter, figures.placement);
  figures.emission = placing.lap();
  BuildOptions options = options_of(flags, input, std::move(placed));
  options.progress = reporter.progress();
  return options;
}

void tell(const BuiltShells& built, Reporter& reporter, BuildFigures& figures) {
  const BuildReport& report = built.report;
  if (report.is_grid_coarse) {
    reporter.warn(
        fmt::format("the quantisation step is {:.3g} of the smallest spacing, more than "
                    "1/64: more bits would be needed",
                    report.step_spacings));
  }
  figures.left_out = tell_pruning(built.set.pruned, reporter);
  figures.extract = report.extract_seconds;
  figures.simplify = report.simplify_seconds + report.snap_seconds;
  figures.encode = report.sink_seconds;
  figures.extracted_triangles = report.extracted_triangles;
}

/// Counts where neighbours cross as they will decode: two at a time are in memory.
void count_crossings_of(const CompressedSet& built, Reporter& reporter, BuildFigures& figures) {
  Stopwatch counting;
  CrossingCounter counter(built.set);
  ProgressMeter progress(reporter.progress(), "nesting", built.shells.size());
  for (std::size_t k = 0; k < built.shells.size(); ++k) {
    const CompressedShell& shell = built.shells[k];
    if (!shell.bytes.empty()) {
      counter.add(k, decode_draco(shell.bytes, {shell.triangles, shell.vertices}));
    }
    progress.advance();
  }
  figures.crossings = counting.lap();
  figures.nesting = tell_nesting(counter.result(), reporter);
}

}  // namespace

ShellSet build_shell_set(const ShellFlags& flags, EmissionVolume input, Reporter& reporter,
                         BuildFigures& figures) {
  const BuildOptions options = options_of(flags, input, reporter, figures);
  BuiltShells built = build_shells(std::move(input.volume), input.emission, options);
  tell(built, reporter, figures);
  return std::move(built.set);
}

CompressedSet build_compressed_set(const ShellFlags& flags, EmissionVolume input,
                                   const std::filesystem::path& scratch_folder, Reporter& reporter,
                                   BuildFigures& figures) {
  BuildOptions options = options_of(flags, input, reporter, figures);
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
  tell(built, reporter, figures);
  result.set = std::move(built.set);
  count_crossings_of(result, reporter, figures);
  return result;
}

CompressedSet build_one_level(const ShellFlags& flags, const EmissionVolume& input,
                              double emission) {
  const BuildOptions options = options_of(flags, input, {{{emission, 1.0}}, "explicit"});
  CompressedSet result;
  result.set = build_shells(input.volume, input.emission, options).set;
  TriangleMesh surface = std::exchange(result.set.shells.front().surface, {});
  result.shells.resize(1);
  if (!surface.triangles.empty()) {
    result.shells.front() = compress_shell(std::move(surface), *result.set.grid, kQuickCompression);
  }
  return result;
}

bool is_simplifying(const ShellFlags& flags) {
  return flags.tolerance > 0.0 || flags.tolerance_mm > 0.0;
}

}  // namespace nacre

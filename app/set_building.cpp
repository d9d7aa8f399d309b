#include "app/set_building.h"

#include <fmt/core.h>

#include <utility>

#include "app/build_words.h"
#include "io/draco_decode.h"
#include "shells/crossings.h"
#include "shells/prune.h"

namespace nacre {
namespace {

/// @param build  builds into the sink that it is given
template <class Build>
BuiltSet compress(std::size_t levels, Build&& build) {
  release_free_memory();
  BuiltSet result;
  result.compressed.shells.resize(levels);
  BuiltShells built = build([&](const ShellSet& set, std::size_t k, TriangleMesh&& surface) {
    result.compressed.shells[k] = compress_shell(std::move(surface), *set.grid);
    release_free_memory();
  });
  result.compressed.set = std::move(built.set);
  result.report = built.report;
  return result;
}

}  // namespace

BuildOptions build_options(const ShellFlags& flags, const glm::dmat4& world_from_voxel,
                           PlacedLevels levels, ProgressCallback progress) {
  BuildOptions options;
  options.levels = std::move(levels.levels);
  options.placement = std::move(levels.placement);
  options.emission_tolerance = flags.tolerance.value_or(0.0);
  options.tolerance_mm = flags.tolerance_mm;
  options.quantization_bits = flags.quantization;
  if (!flags.keep_specks) {
    options.min_component_mm3 = flags.min_component.value_or(default_speck_mm3(world_from_voxel));
  }
  options.prune_inner = flags.purpose == "max";
  options.progress = std::move(progress);
  return options;
}

BuiltSet build_and_compress(Volume&& volume, const EmissionMap& emission,
                            const BuildOptions& options) {
  return compress(options.levels.size(), [&](const SurfaceSink& sink) {
    return build_shells(std::move(volume), emission, options, sink);
  });
}

BuiltSet build_and_compress(const Volume& volume, const EmissionMap& emission,
                            const BuildOptions& options) {
  return compress(options.levels.size(), [&](const SurfaceSink& sink) {
    return build_shells(volume, emission, options, sink);
  });
}

void tell_build(const ShellSet& set, const BuildReport& report, Reporter& reporter,
                BuildFigures& figures) {
  if (report.is_grid_coarse) {
    reporter.warn(
        fmt::format("the quantisation step is {:.3g} of the smallest spacing, more than "
                    "1/64: more bits would be needed",
                    report.step_spacings));
  }
  figures.left_out = tell_pruning(set.pruned, reporter);
  figures.extract = report.extract_seconds;
  figures.simplify = report.simplify_seconds + report.snap_seconds;
  figures.encode = report.sink_seconds;
  figures.extracted_triangles = report.extracted_triangles;
}

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

}  // namespace nacre

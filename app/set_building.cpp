#include "app/set_building.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "app/build_words.h"
#include "io/draco_decode.h"
#include "shells/crossings.h"
#include "shells/prune.h"

namespace nacre {
namespace {

// A set that loads and draws at once on two cores as it is gets no copies.
constexpr std::size_t kManyTriangles = 200'000;
// Of copies, in mean layer widths, and at least so many times the shells' own
// (docs/decisions/024-coarse-copies.md).
constexpr double kCoarseLayers = 2.0;
constexpr double kCoarser = 3.0;
constexpr double kCoarsest = 0.25;
// Of the shells' bytes: copies that nobody asked for may take so many.
constexpr double kMostOfBytes = 0.3;

/// The copies that a build left, compressed side by side.
std::optional<CoarseShells> compress_copies(std::vector<TriangleMesh>&& copies, const ShellSet& set,
                                            double tolerance, int compression) {
  if (copies.empty()) return std::nullopt;
  CoarseShells coarse{.tolerance = tolerance};
  coarse.shells.resize(copies.size());
  tbb::parallel_for(std::size_t{0}, copies.size(), [&](std::size_t k) {
    coarse.shells[k] = compress_shell(std::move(copies[k]), *set.grid, compression);
  });
  return coarse;
}

/// @param build  builds into the sink that it is given
template <class Build>
BuiltSet compress(const BuildOptions& options, int compression, Build&& build) {
  release_free_memory();
  BuiltSet result;
  result.compressed.shells.resize(options.levels.size());
  BuiltShells built = build([&](const ShellSet& set, std::size_t k, TriangleMesh&& surface) {
    result.compressed.shells[k] = compress_shell(std::move(surface), *set.grid, compression);
    release_free_memory();
  });
  result.compressed.set = std::move(built.set);
  result.compressed.coarse = compress_copies(std::move(built.copies), result.compressed.set,
                                             options.coarse_tolerance, compression);
  result.report = built.report;
  return result;
}

std::size_t byte_count(const std::vector<CompressedShell>& shells) {
  std::size_t bytes = 0;
  for (const CompressedShell& shell : shells) bytes += shell.bytes.size();
  return bytes;
}

/// 0 where copies would not be much coarser than the shells, or those are not simplified.
double chosen_tolerance(const BuildOptions& options) {
  const double own = options.emission_tolerance;
  const double at_mean_slope = own / weight_at_mean_slope(options.tolerance_weight);
  const auto levels = static_cast<double>(std::max<std::size_t>(options.levels.size(), 1));
  const double chosen = std::min(kCoarseLayers / levels, kCoarsest);
  return own > 0.0 && chosen > own && chosen >= kCoarser * at_mean_slope ? chosen : 0.0;
}

void set_copies(BuildOptions& options, const ShellFlags& flags) {
  options.coarse_tolerance = named_copies_tolerance(flags);
  if (flags.coarse != kAutoCopies) return;
  options.coarse_tolerance = chosen_tolerance(options);
  options.coarse_above_triangles = kManyTriangles;
}

/// So many shells may be in memory while neighbours are counted, beside the one counted last: what
/// compressing them may take (docs/decisions/006-memory-of-a-build.md), and few in any case.
std::size_t decoded_at_once(std::size_t largest_triangles) {
  constexpr std::size_t kBytesOfTriangle = 120;
  constexpr std::size_t kMostBytes = 128'000'000;
  constexpr std::size_t kMostDecoded = 4;
  const std::size_t fit = kMostBytes / (kBytesOfTriangle * largest_triangles);
  return std::clamp<std::size_t>(fit, 1, kMostDecoded);
}

}  // namespace

BuildOptions build_options(const ShellFlags& flags, const glm::dmat4& world_from_voxel,
                           PlacedLevels levels, ProgressCallback progress) {
  BuildOptions options;
  options.levels = std::move(levels.levels);
  options.placement = std::move(levels.placement);
  options.emission_tolerance = flags.tolerance.value_or(0.0);
  if (flags.tolerance_weight == kPictureWeight) options.tolerance_weight = ToleranceWeight::Picture;
  set_copies(options, flags);
  options.tolerance_mm = flags.tolerance_mm;
  options.quantization_bits = flags.quantization;
  if (!flags.keep_specks) {
    options.min_component_mm3 = flags.min_component.value_or(default_speck_mm3(world_from_voxel));
  }
  options.prune_inner = flags.purpose == "max";
  options.progress = std::move(progress);
  return options;
}

int compression_of(const ShellFlags& flags) {
  return flags.compression.value_or(effort_for(is_simplifying(flags)));
}

BuiltSet build_and_compress(Volume&& volume, const EmissionMap& emission,
                            const BuildOptions& options, int compression) {
  return compress(options, compression, [&](const SurfaceSink& sink) {
    return build_shells(std::move(volume), emission, options, sink);
  });
}

BuiltSet build_and_compress(const Volume& volume, const EmissionMap& emission,
                            const BuildOptions& options, int compression) {
  return compress(options, compression, [&](const SurfaceSink& sink) {
    return build_shells(volume, emission, options, sink);
  });
}

void drop_large_copies(CompressedSet& built, Reporter& reporter) {
  if (!built.coarse) return;
  const double part = static_cast<double>(byte_count(built.coarse->shells)) /
                      static_cast<double>(byte_count(built.shells));
  if (part <= kMostOfBytes) return;
  reporter.say(
      fmt::format("copies       left out: they would add {:.0f} % to the file", 100.0 * part));
  built.coarse.reset();
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
  figures.coarsen = report.coarsen_seconds;
  figures.encode = report.sink_seconds;
  figures.extracted_triangles = report.extracted_triangles;
}

void count_crossings_of(const CompressedSet& built, Reporter& reporter, BuildFigures& figures) {
  Stopwatch counting;
  std::vector<std::size_t> shells;
  std::size_t largest = 1;
  for (std::size_t k = 0; k < built.shells.size(); ++k) {
    if (built.shells[k].bytes.empty()) continue;
    shells.push_back(k);
    largest = std::max(largest, built.shells[k].triangles);
  }
  const auto decode = [&](std::size_t k) {
    const CompressedShell& shell = built.shells[k];
    return decode_draco(shell.bytes, {shell.triangles, shell.vertices});
  };
  const auto crossings = count_neighbour_crossings(built.set, shells, decode,
                                                   decoded_at_once(largest), reporter.progress());
  figures.crossings = counting.lap();
  figures.nesting = tell_nesting(crossings, reporter);
}

}  // namespace nacre

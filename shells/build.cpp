#include "shells/build.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "core/error.h"
#include "core/volume_geometry.h"
#include "extract/marching_cubes.h"
#include "shells/coarsen.h"
#include "shells/level_field.h"
#include "shells/picture_weight.h"
#include "shells/prune.h"
#include "shells/quantization.h"
#include "shells/refine.h"
#include "shells/simplify.h"
#include "shells/trilinear_field.h"
#include "shells/voxel_checksum.h"

namespace nacre {
namespace {

// Emission error above which contoured triangles are divided, unless the tolerance is larger: less
// gains little, for several times the triangles.
constexpr double kFineEnough = 0.02;
// Up to such a tolerance at the mean slope, passes over the edges go before their queue: half to
// nine tenths of the time, and a set as good at equal bytes. With a larger one they leave a worse
// set (docs/decisions/014-simplifying-against-the-field.md).
constexpr double kPassesUpTo = 0.05;
// Where maxima decide, following the field counts more than keeping the volume inside: 0.05 to 0.15
// dB (docs/decisions/014-simplifying-against-the-field.md).
constexpr double kPictureVolumeWeight = 1.0;

/// What a volume and its surfaces, while they wait, may hold in memory together; and the surfaces
/// of a larger volume.
constexpr std::size_t kHeldBytes = std::size_t{64} << 20;
constexpr std::size_t kLeastHeldBytes = std::size_t{1} << 18;

/// What snapping or compressing a shell takes at its peak, measured (docs/decisions/006).
constexpr std::size_t kWorkingBytesPerTriangle = 120;
constexpr std::size_t kLeastWorkingMemory = std::size_t{128} << 20;

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void check_levels(std::span<const Level> levels) {
  double below = 0.0;
  for (const Level& level : levels) {
    if (!(level.emission > below && level.emission <= 1.0)) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("levels: found {} after {}, expected ascending emissions above 0 and "
                              "up to 1",
                              level.emission, below));
    }
    below = level.emission;
  }
}

ShellSet describe(const Volume& volume, const EmissionMap& emission, const BuildOptions& options) {
  ShellSet set;
  set.center_mm = bounding_sphere(volume.dims, volume.world_from_voxel).center_mm;
  set.volume = {volume.dims,  volume.world_from_voxel, volume.type,
                volume.slope, volume.intercept,        voxel_checksum(volume)};
  set.emission.assign(emission.knots().begin(), emission.knots().end());
  set.placement = options.placement;
  set.tolerance = options.emission_tolerance;
  if (options.emission_tolerance > 0.0) set.tolerance_weight = options.tolerance_weight;
  for (const Level& level : options.levels) {
    Shell shell;
    shell.emission = level.emission;
    shell.value = emission.value_at(level.emission);
    shell.representative = level.representative;
    shell.sum_representative = level.sum_representative;
    set.shells.push_back(std::move(shell));
  }
  return set;
}

ExtractedSurfaces extract(const Volume& volume, const BuildOptions& options, const ShellSet& set) {
  std::vector<double> values;
  values.reserve(set.shells.size());
  for (const Shell& shell : set.shells) values.push_back(shell.value);
  SurfaceStorage storage;
  storage.scratch_folder = options.scratch_folder;
  storage.memory_bytes =
      std::max(kHeldBytes - std::min(volume.samples.size(), kHeldBytes), kLeastHeldBytes);
  return extract_surfaces(volume, values, storage, options.progress);
}

/// Calls `function(k)` with every shell, in parallel, as far as the shells at work fit in the
/// memory that they may take.
///
/// The largest come first: one of them alone at the end would keep one thread busy.
///
/// @param triangles  of each shell
template <class Function>
void for_each_shell(std::span<const std::size_t> triangles, std::size_t memory_bytes,
                    const ProgressCallback& callback, std::string_view stage, Function&& function) {
  std::vector<std::size_t> order(triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return triangles[a] > triangles[b]; });
  const auto at_a_time = [&](std::size_t i) {
    const std::size_t fit =
        memory_bytes / (kWorkingBytesPerTriangle * std::max<std::size_t>(triangles[order[i]], 1));
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    return std::clamp<std::size_t>(fit, 1, threads);
  };
  ProgressMeter progress(callback, stage, std::reduce(triangles.begin(), triangles.end()));
  for (std::size_t begin = 0; begin < order.size();) {
    // As many as may work side by side in the memory of the first.
    const std::size_t width = at_a_time(begin);
    std::size_t end = begin + 1;
    while (end < order.size() && at_a_time(end) == width) ++end;
    tbb::task_arena arena(static_cast<int>(width));
    arena.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::size_t>(begin, end, 1),
          [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
              function(order[i]);
              progress.advance(triangles[order[i]]);
            }
          },
          tbb::simple_partitioner());
    });
    begin = end;
  }
}

/// What shells at work may take: the place of the volume that is gone by then, and a quarter.
std::size_t working_memory(const Volume& volume) {
  return std::max(volume.samples.size() / 4 * 5, kLeastWorkingMemory);
}

bool is_simplifying(const BuildOptions& options) {
  return options.emission_tolerance > 0.0 || options.tolerance_mm > 0.0 ||
         options.target_triangles > 0;
}

/// What simplification must keep of a shell, but for its tolerances.
SimplifyOptions bounds_of(const TrilinearField& field, const Volume& volume, const ShellSet& set,
                          const BorderRounding& border) {
  const glm::dvec3 spacing = spacing_mm(volume.world_from_voxel);
  SimplifyOptions bounds;
  bounds.samples_from_mm = field.voxel_from_mm();
  bounds.spacing_mm = std::min({spacing.x, spacing.y, spacing.z});
  bounds.grid = set.grid;
  bounds.border = &border;
  return bounds;
}

/// Divides a contoured surface where it strays from its level, and simplifies it within what the
/// options allow; those of `bounds` are what shells have in common.
TriangleMesh simplify_on_level(const TriangleMesh& contour, const LevelField& off_level,
                               const BuildOptions& options, SimplifyOptions bounds) {
  const bool is_weighted = options.tolerance_weight == ToleranceWeight::Picture;
  bounds.error_tolerance = options.emission_tolerance;
  bounds.field = off_level;
  const double at_mean_slope =
      options.emission_tolerance / weight_at_mean_slope(options.tolerance_weight);
  const TriangleMesh refined = refine(
      contour, bounds.field,
      {.error_tolerance = std::max(at_mean_slope, kFineEnough), .reach_mm = bounds.spacing_mm});
  if (is_weighted) {
    bounds.field =
        PictureWeight(off_level, mean_slope(refined, bounds.field), options.emission_tolerance);
    bounds.volume_weight = kPictureVolumeWeight;
  }
  const bool has_other_bounds = bounds.tolerance_mm > 0.0 || bounds.target_triangles > 0;
  if (has_other_bounds || at_mean_slope > kPassesUpTo) return simplify(refined, bounds);
  const CoarsenOptions passes{.error_tolerance = bounds.error_tolerance,
                              .samples_from_mm = bounds.samples_from_mm,
                              .spacing_mm = bounds.spacing_mm};
  return simplify(coarsen(refined, bounds.field, passes), bounds);
}

void simplify_shells(const Volume& volume, const EmissionMap& emission, const BuildOptions& options,
                     std::span<const std::size_t> triangles,
                     const std::function<TriangleMesh(std::size_t)>& source,
                     const BorderRounding& border, ShellSet& set) {
  const auto extracted_triangles = std::reduce(triangles.begin(), triangles.end());
  const TrilinearField field(volume);
  const SimplifyOptions common = bounds_of(field, volume, set, border);
  const std::size_t memory = working_memory(volume);
  for_each_shell(triangles, memory, options.progress, "simplify", [&](std::size_t k) {
    Shell& shell = set.shells[k];
    shell.surface = source(k);
    SimplifyOptions bounds = common;
    bounds.tolerance_mm = options.tolerance_mm;
    const auto extracted = static_cast<double>(shell.surface.triangles.size());
    // Every shell keeps the same part of its triangles.
    bounds.target_triangles = static_cast<std::size_t>(
        static_cast<double>(options.target_triangles) /
        static_cast<double>(std::max<std::size_t>(extracted_triangles, 1)) * extracted);
    shell.surface =
        options.emission_tolerance > 0.0
            ? simplify_on_level(shell.surface, LevelField(field, emission, shell.emission), options,
                                bounds)
            : simplify(shell.surface, bounds);
  });
}

/// Coarser copies of simplified shells, on the grid already: a seventh of the time that the
/// shells' own simplification takes (docs/decisions/024-coarse-copies.md).
std::vector<TriangleMesh> coarser_copies(const Volume& volume, const EmissionMap& emission,
                                         const BuildOptions& options,
                                         std::span<const std::size_t> triangles,
                                         const BorderRounding& border, const ShellSet& set) {
  std::vector<TriangleMesh> copies(set.shells.size());
  const TrilinearField field(volume);
  const SimplifyOptions common = bounds_of(field, volume, set, border);
  const CoarsenOptions bounds{.error_tolerance = options.coarse_tolerance,
                              .samples_from_mm = common.samples_from_mm,
                              .spacing_mm = common.spacing_mm};
  const std::size_t memory = working_memory(volume);
  for_each_shell(triangles, memory, options.progress, "coarsen", [&](std::size_t k) {
    const Shell& shell = set.shells[k];
    if (shell.surface.triangles.empty()) return;
    const LevelField off_level(field, emission, shell.emission);
    copies[k] = snap(coarsen(shell.surface, off_level, bounds), *set.grid, &border).mesh;
  });
  return copies;
}

/// What snapping takes from, and gives to.
struct SnapEnds {
  std::function<TriangleMesh(std::size_t k)> source;
  const SurfaceSink& sink;
  const BorderRounding& border;
};

/// @param set  its surfaces are those the sink does not take
void snap_shells(std::span<const std::size_t> triangles, std::size_t memory, const SnapEnds& ends,
                 const BuildOptions& options, ShellSet& set, BuildReport& report) {
  std::vector<BuildReport> parts(set.shells.size());
  const Stopwatch watch;
  for_each_shell(triangles, memory, options.progress, "snap", [&](std::size_t k) {
    const Stopwatch snapping;
    SnappedSurface snapped = snap(ends.source(k), *set.grid, &ends.border);
    parts[k].snapped = snapped.report;
    parts[k].triangles = snapped.mesh.triangles.size();
    parts[k].snap_seconds = snapping.seconds();
    const Stopwatch sinking;
    if (!ends.sink) {
      set.shells[k].surface = std::move(snapped.mesh);
    } else if (parts[k].triangles > 0) {
      ends.sink(set, k, std::move(snapped.mesh));
    }
    parts[k].sink_seconds = sinking.seconds();
  });
  const double seconds = watch.seconds();
  for (const BuildReport& part : parts) {
    report.snapped += part.snapped;
    report.triangles += part.triangles;
    report.snap_seconds += part.snap_seconds;
    report.sink_seconds += part.sink_seconds;
  }
  // The two ran side by side: each is given its part of the time that passed.
  const double sum = report.snap_seconds + report.sink_seconds;
  const double scale = sum > seconds ? seconds / sum : 1.0;
  report.snap_seconds *= scale;
  report.sink_seconds *= scale;
}

/// @param volume_done  called when the volume is not needed any more
BuiltShells build(const Volume& volume, const EmissionMap& emission, const BuildOptions& options,
                  const SurfaceSink& sink, const std::function<void()>& volume_done) {
  check_levels(options.levels);
  BuiltShells built{.set = describe(volume, emission, options)};
  const GridChoice grid =
      choose_grid(volume.dims, volume.world_from_voxel, {.bits = options.quantization_bits});
  built.set.grid = grid.grid;
  const BorderRounding border(built.set);
  BuildReport& report = built.report;
  report.step_spacings = grid.step_spacings;
  report.is_grid_coarse = grid.is_coarse;

  const Stopwatch extracting;
  ExtractedSurfaces surfaces = extract(volume, options, built.set);
  report.extract_seconds = extracting.seconds();
  std::vector<std::size_t> triangles(surfaces.size());
  for (std::size_t k = 0; k < triangles.size(); ++k) triangles[k] = surfaces.triangle_count(k);
  report.extracted_triangles = std::reduce(triangles.begin(), triangles.end());
  const std::size_t memory = working_memory(volume);
  Pruner pruner(surfaces.size(), {.min_component_mm3 = options.min_component_mm3,
                                  .prune_inner = options.prune_inner});
  SnapEnds ends{[&](std::size_t k) { return pruner.prune(k, surfaces.take(k)); }, sink, border};

  if (is_simplifying(options)) {
    const Stopwatch simplifying;
    simplify_shells(volume, emission, options, triangles, ends.source, border, built.set);
    report.simplify_seconds = simplifying.seconds();
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      triangles[k] = built.set.shells[k].surface.triangles.size();
    }
    ends.source = [&](std::size_t k) { return std::exchange(built.set.shells[k].surface, {}); };
    const std::size_t left = std::reduce(triangles.begin(), triangles.end());
    if (options.coarse_tolerance > 0.0 && left > options.coarse_above_triangles) {
      const Stopwatch coarsening;
      built.copies = coarser_copies(volume, emission, options, triangles, border, built.set);
      report.coarsen_seconds = coarsening.seconds();
    }
  }
  volume_done();
  snap_shells(triangles, memory, ends, options, built.set, report);
  built.set.pruned = pruner.result(built.set);
  return built;
}

}  // namespace

BuiltShells build_shells(const Volume& volume, const EmissionMap& emission,
                         const BuildOptions& options) {
  return build(volume, emission, options, {}, [] {});
}

BuiltShells build_shells(const Volume& volume, const EmissionMap& emission,
                         const BuildOptions& options, const SurfaceSink& sink) {
  return build(volume, emission, options, sink, [] {});
}

BuiltShells build_shells(Volume&& volume, const EmissionMap& emission,
                         const BuildOptions& options) {
  return build_shells(std::move(volume), emission, options, {});
}

BuiltShells build_shells(Volume&& volume, const EmissionMap& emission, const BuildOptions& options,
                         const SurfaceSink& sink) {
  std::optional<Volume> kept(std::move(volume));
  return build(*kept, emission, options, sink, [&] { kept.reset(); });
}

}  // namespace nacre

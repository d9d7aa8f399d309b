#include "shells/build.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <span>

#include "core/error.h"
#include "core/quantization_grid.h"
#include "core/volume_geometry.h"
#include "extract/marching_cubes.h"
#include "shells/prune.h"
#include "shells/quantization.h"
#include "shells/simplify.h"
#include "shells/trilinear_field.h"
#include "shells/voxel_checksum.h"

namespace nacre {
namespace {

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

void extract(const Volume& volume, const BuildOptions& options, ShellSet& set) {
  std::vector<double> values;
  values.reserve(set.shells.size());
  for (const Shell& shell : set.shells) values.push_back(shell.value);
  std::vector<TriangleMesh> surfaces = extract_surfaces(volume, values, options.progress);
  for (std::size_t k = 0; k < surfaces.size(); ++k) set.shells[k].surface = std::move(surfaces[k]);
}

/// The largest shells first: one of them alone at the end would keep one thread busy.
std::vector<std::size_t> largest_first(const ShellSet& set) {
  std::vector<std::size_t> order(set.shells.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return set.shells[a].surface.triangles.size() > set.shells[b].surface.triangles.size();
  });
  return order;
}

/// Calls `function(k)` with every shell, in parallel.
template <class Function>
void for_each_shell(const ShellSet& set, const ProgressCallback& callback, std::string_view stage,
                    Function&& function) {
  const std::vector<std::size_t> order = largest_first(set);
  ProgressMeter progress(callback, stage, order.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, order.size(), 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          function(order[i]);
          progress.advance();
        }
      },
      tbb::simple_partitioner());
}

bool is_simplifying(const BuildOptions& options) {
  return options.emission_tolerance > 0.0 || options.tolerance_mm > 0.0 ||
         options.target_triangles > 0;
}

void simplify_shells(const Volume& volume, const EmissionMap& emission, const BuildOptions& options,
                     std::size_t extracted_triangles, ShellSet& set) {
  const TrilinearField field(volume);
  const glm::dvec3 spacing = spacing_mm(volume.world_from_voxel);
  for_each_shell(set, options.progress, "simplify", [&](std::size_t k) {
    Shell& shell = set.shells[k];
    SimplifyOptions bounds;
    bounds.tolerance_mm = options.tolerance_mm;
    bounds.sample_spacing_mm = std::min({spacing.x, spacing.y, spacing.z});
    if (options.emission_tolerance > 0.0) {
      bounds.error_tolerance = options.emission_tolerance;
      bounds.error = LevelError(field, emission, shell.emission);
    }
    // Every shell keeps the same part of its triangles.
    bounds.target_triangles = static_cast<std::size_t>(
        static_cast<double>(options.target_triangles) /
        static_cast<double>(std::max<std::size_t>(extracted_triangles, 1)) *
        static_cast<double>(shell.surface.triangles.size()));
    shell.surface = simplify(shell.surface, bounds);
  });
}

void snap_shells(const BuildOptions& options, ShellSet& set, SnapReport& report) {
  std::vector<SnapReport> reports(set.shells.size());
  for_each_shell(set, options.progress, "snap", [&](std::size_t k) {
    SnappedSurface snapped = snap(set.shells[k].surface, *set.grid);
    set.shells[k].surface = std::move(snapped.mesh);
    reports[k] = snapped.report;
  });
  for (const SnapReport& shell : reports) report += shell;
}

/// What the surfaces may meet, now that they lie where they will.
std::vector<StrayTriangles> stray_triangles(const Volume& volume, const EmissionMap& emission,
                                            const ShellSet& set) {
  const TrilinearField field(volume);
  std::vector<StrayTriangles> strays(set.shells.size());
  for_each_shell(set, {}, "", [&](std::size_t k) {
    const Shell& shell = set.shells[k];
    const bool first = k == 0;
    const bool last = k + 1 == set.shells.size();
    const double below = first ? -1.0 : 0.5 * (set.shells[k - 1].emission + shell.emission);
    const double above = last ? 2.0 : 0.5 * (shell.emission + set.shells[k + 1].emission);
    strays[k] =
        find_stray_triangles(shell.surface, field, emission, below, above, step_mm(*set.grid));
  });
  return strays;
}

std::size_t triangle_count(const ShellSet& set) {
  std::size_t count = 0;
  for (const Shell& shell : set.shells) count += shell.surface.triangles.size();
  return count;
}

/// @param volume_done  called when the volume is not needed any more
BuiltShells build(const Volume& volume, const EmissionMap& emission, const BuildOptions& options,
                  const std::function<void()>& volume_done) {
  check_levels(options.levels);
  BuiltShells built{describe(volume, emission, options), {}};
  const GridChoice grid =
      choose_grid(volume.dims, volume.world_from_voxel, {.bits = options.quantization_bits});
  built.set.grid = grid.grid;
  BuildReport& report = built.report;
  report.step_spacings = grid.step_spacings;
  report.is_grid_coarse = grid.is_coarse;

  const Stopwatch extracting;
  extract(volume, options, built.set);
  report.extract_seconds = extracting.seconds();
  report.extracted_triangles = triangle_count(built.set);

  const Stopwatch pruning;
  built.set.pruned = prune(built.set, {.min_component_mm3 = options.min_component_mm3,
                                       .prune_inner = options.prune_inner,
                                       .progress = options.progress});
  report.prune_seconds = pruning.seconds();

  if (is_simplifying(options)) {
    const Stopwatch simplifying;
    simplify_shells(volume, emission, options, report.extracted_triangles, built.set);
    report.simplify_seconds = simplifying.seconds();
  }
  const Stopwatch snapping;
  snap_shells(options, built.set, report.snapped);
  report.snap_seconds = snapping.seconds();
  const Stopwatch crossing;
  const std::vector<StrayTriangles> strays = stray_triangles(volume, emission, built.set);
  volume_done();
  report.crossings = count_crossings(built.set, strays);
  report.crossings_seconds = crossing.seconds();
  report.triangles = triangle_count(built.set);
  return built;
}

}  // namespace

BuiltShells build_shells(const Volume& volume, const EmissionMap& emission,
                         const BuildOptions& options) {
  return build(volume, emission, options, [] {});
}

BuiltShells build_shells(Volume&& volume, const EmissionMap& emission,
                         const BuildOptions& options) {
  std::optional<Volume> kept(std::move(volume));
  return build(*kept, emission, options, [&] { kept.reset(); });
}

}  // namespace nacre

#include "shells/verify.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "core/quantization_grid.h"
#include "core/volume_geometry.h"
#include "extract/marching_cubes.h"
#include "shells/border_planes.h"
#include "shells/prune.h"
#include "shells/triangle_tree.h"

namespace nacre {
namespace {

// Bounds of distances are this close, in smallest spacings.
constexpr double kDistanceError = 1.0 / 20.0;
// Simplification looks at samples about a voxel apart; between them a surface may be this much
// farther off.
constexpr double kBetweenSamples = 1.25;

bool is_empty(const ShellSet& set, std::size_t k) {
  return set.shells[k].surface.triangles.empty();
}

std::size_t positions_off_grid(const ShellSet& set, std::size_t k) {
  if (!set.grid) return 0;
  const auto& positions = set.shells[k].surface.positions;
  return static_cast<std::size_t>(
      std::count_if(positions.begin(), positions.end(),
                    [&](const glm::vec3& p) { return !is_on(*set.grid, p); }));
}

double least_distance(const TriangleMesh& from, const TriangleTree& to, const BorderPlanes& border,
                      double least) {
  for (const glm::vec3& p : from.positions) {
    if (!border.contain(p)) least = to.distance(glm::dvec3(p), least);
  }
  return least;
}

NeighbourReport compare_neighbours(const ShellSet& set, std::size_t k, std::size_t inner) {
  const BorderPlanes border(set);
  const TriangleMesh a = border.without_caps(set.shells[k].surface);
  const TriangleMesh b = border.without_caps(set.shells[inner].surface);
  NeighbourReport report{inner, mutual_intersections(a, b), 0.0};
  if (report.intersections.crossing > 0) return report;
  report.gap_mm =
      least_distance(a, TriangleTree(b), border, std::numeric_limits<double>::infinity());
  report.gap_mm = least_distance(b, TriangleTree(a), border, report.gap_mm);
  return report;
}

std::optional<std::size_t> next_shell(const ShellSet& set, std::size_t k) {
  for (std::size_t inner = k + 1; inner < set.shells.size(); ++inner) {
    if (!is_empty(set, inner)) return inner;
  }
  return std::nullopt;
}

/// A piece of work and about how much it is.
struct Job {
  std::size_t triangles;
  std::function<void()> run;
};

/// The largest first, in parallel: one of them alone at the end would keep one thread busy.
void run_all(std::vector<Job> jobs, const ProgressCallback& callback, std::string_view stage) {
  std::stable_sort(jobs.begin(), jobs.end(),
                   [](const Job& a, const Job& b) { return a.triangles > b.triangles; });
  ProgressMeter progress(callback, stage, jobs.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, jobs.size(), 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          jobs[i].run();
          progress.advance();
        }
      },
      tbb::simple_partitioner());
}

void add_if(std::vector<std::string>& list, std::size_t count, std::string_view what) {
  if (count > 0) list.push_back(fmt::format("{} {}", count, what));
}

/// The set before simplification and snapping: contoured, and pruned as the set says it was.
ShellSet make_anew(const ShellSet& set, const Volume& volume, const ProgressCallback& progress) {
  std::vector<double> values;
  for (const Shell& shell : set.shells) values.push_back(shell.value);
  std::vector<TriangleMesh> surfaces = extract_surfaces(volume, values, progress);
  ShellSet anew;
  for (TriangleMesh& surface : surfaces) {
    anew.shells.emplace_back().surface = std::move(surface);
  }
  prune(anew, {.min_component_mm3 = set.pruned.min_component_mm3,
               .prune_inner = set.pruned.inner_pruned});
  return anew;
}

}  // namespace

std::vector<ShellVerdict> verify_surfaces(const ShellSet& set, const VerifyOptions& options) {
  std::vector<ShellVerdict> verdicts(set.shells.size());
  std::vector<Job> jobs;
  for (std::size_t k = 0; k < set.shells.size(); ++k) {
    if (is_empty(set, k)) continue;
    const TriangleMesh& surface = set.shells[k].surface;
    const std::size_t triangles = surface.triangles.size();
    ShellVerdict& verdict = verdicts[k];
    jobs.push_back({triangles, [&set, k, &verdict, &surface] {
                      verdict.topology = check_shell(surface);
                      verdict.off_grid = positions_off_grid(set, k);
                    }});
    jobs.push_back({3 * triangles, [&verdict, &surface] {
                      verdict.self_intersections = self_intersections(surface);
                    }});
    const auto inner = next_shell(set, k);
    if (!inner || !options.neighbours) continue;
    jobs.push_back({4 * triangles, [&set, k, &verdict, next = *inner] {
                      verdict.next = compare_neighbours(set, k, next);
                    }});
  }
  run_all(std::move(jobs), options.progress, "verify");
  return verdicts;
}

std::vector<VolumeVerdict> verify_against_volume(const ShellSet& set, const Volume& volume,
                                                 const ProgressCallback& progress) {
  const TrilinearField field(volume);
  const EmissionMap emission = EmissionMap::piecewise_linear(set.emission);
  const ShellSet anew = make_anew(set, volume, progress);
  const glm::dvec3 spacing = spacing_mm(volume.world_from_voxel);
  const double distance_error = kDistanceError * std::min({spacing.x, spacing.y, spacing.z});
  const double step = set.grid ? step_mm(*set.grid) : 0.0;

  std::vector<VolumeVerdict> verdicts(set.shells.size());
  ProgressMeter meter(progress, "measure", set.shells.size());
  for (std::size_t k = 0; k < set.shells.size(); ++k) {
    const Shell& shell = set.shells[k];
    VolumeVerdict& verdict = verdicts[k];
    verdict.emission = measure_surface_emission(shell.surface, field, emission, shell.emission,
                                                set.tolerance, step);
    verdict.extraction_error_bound =
        bound_surface_emission(anew.shells[k].surface, field, emission).error_bound(shell.emission);
    verdict.to_unsimplified =
        hausdorff_distance(shell.surface, anew.shells[k].surface, distance_error);
    verdict.from_unsimplified =
        hausdorff_distance(anew.shells[k].surface, shell.surface, distance_error);
    if (set.tolerance > 0.0) {
      const double allowed = std::max(set.tolerance, verdict.extraction_error_bound);
      verdict.tolerance_kept =
          verdict.emission.max_error_less_snapping <= kBetweenSamples * allowed;
    }
    meter.advance();
  }
  return verdicts;
}

std::vector<std::string> broken_promises(const ShellVerdict& verdict) {
  std::vector<std::string> broken;
  const ShellReport& topology = verdict.topology;
  add_if(broken, topology.open_edges, "open edges");
  add_if(broken, topology.misoriented_edges, "edges of opposite orientation");
  add_if(broken, topology.crowded_edges, "edges of more than two triangles");
  add_if(broken, topology.crowded_vertices, "vertices of more than one fan");
  add_if(broken, topology.coincident_vertices, "vertices at another's position");
  add_if(broken, topology.degenerate, "triangles without area");
  add_if(broken, verdict.off_grid, "positions off the grid");
  if (topology.triangles > 0 && !(topology.volume_mm3 > 0.0)) {
    broken.push_back(fmt::format("a volume of {:.4g} mm3, inside out", topology.volume_mm3));
  }
  return broken;
}

}  // namespace nacre

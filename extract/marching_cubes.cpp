#include "extract/marching_cubes.h"

#include <fmt/core.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "extract/slab_sweep.h"
#include "extract/swept_surfaces.h"

namespace nacre {
namespace {

/// Classes have eight bits.
constexpr std::size_t kLevelsPerSweep = 255;

/// Slabs a thread should have, so that uneven ones even out; their thickness changes no output.
constexpr std::size_t kSlabsPerThread = 4;
/// Thicker slabs need more memory before they are appended, thinner ones sweep more slices twice.
constexpr std::size_t kThickestSlab = 8;
constexpr std::size_t kThinnestSlab = 4;

void check_values(std::span<const double> values) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!std::isfinite(values[k])) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("contour value {}: found {}, expected a finite one", k, values[k]));
    }
    if (k > 0 && !(values[k] > values[k - 1])) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("contour value {}: found {} after {}, expected ascending values", k,
                              values[k], values[k - 1]));
    }
  }
}

std::vector<Slab> cut_into_slabs(std::size_t layers) {
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  const std::size_t thickness =
      std::clamp(layers / (kSlabsPerThread * threads), kThinnestSlab, kThickestSlab);
  std::vector<Slab> slabs;
  for (std::size_t begin = 0; begin < layers; begin += thickness) {
    slabs.push_back({begin, std::min(begin + thickness, layers)});
  }
  return slabs;
}

/// All reached levels. Slabs are swept on all threads and appended in order, as soon as those below
/// them are there: at most one a thread stands in memory beside the surfaces, and its memory is
/// used again.
template <class T>
std::unique_ptr<SweptSurfaces> sweep(const Volume& volume, const SweepGrid& grid,
                                     const StoredLevels<T>& levels, const SurfaceStorage& storage,
                                     ProgressMeter& meter) {
  const SampleClasses<T> classes(levels);
  const LatticeVertices<T> vertices(grid, levels, classes, samples_as<T>(volume));
  const SampleReader samples(volume);
  const CellContours contours(grid, samples, levels.crossings, levels.descending);
  const std::vector<Slab> slabs = cut_into_slabs(grid.dims[2] - 1);
  auto surfaces =
      std::make_unique<SweptSurfaces>(slabs.size(), levels.count, grid.left_handed, storage);
  tbb::enumerable_thread_specific<SweepWorkspace> workspaces(
      [&grid] { return SweepWorkspace(grid); });
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  std::vector<SlabOutput> outputs;
  for (std::size_t i = 0; i < std::min(threads, slabs.size()); ++i) {
    outputs.emplace_back(levels.count);
  }

  std::size_t next = 0;
  const auto number = [&](tbb::flow_control& flow) {
    if (next == slabs.size()) flow.stop();
    return next++;
  };
  const auto sweep_one = [&](std::size_t s) {
    sweep_slab(slabs[s], vertices, contours, grid, workspaces.local(), outputs[s % outputs.size()]);
    return s;
  };
  // Slab s is appended before slab s + outputs.size() is numbered, which takes its output over.
  const auto append = [&](std::size_t s) {
    surfaces->append(outputs[s % outputs.size()]);
    if (surfaces->is_storing()) {
      outputs[s % outputs.size()] = SlabOutput(levels.count);  // memory is what matters then
    } else {
      outputs[s % outputs.size()].clear();
    }
    meter.advance(slabs[s].end - slabs[s].begin);
  };
  using tbb::filter_mode;
  tbb::parallel_pipeline(
      outputs.size(),
      tbb::make_filter<void, std::size_t>(filter_mode::serial_in_order, number) &
          tbb::make_filter<std::size_t, std::size_t>(filter_mode::parallel, sweep_one) &
          tbb::make_filter<std::size_t, void>(filter_mode::serial_in_order, append));
  return surfaces;
}

}  // namespace

ExtractedSurfaces::ExtractedSurfaces(std::vector<std::unique_ptr<SweptSurfaces>> sweeps,
                                     std::size_t size)
    : sweeps_(std::move(sweeps)), size_(size) {}

std::size_t ExtractedSurfaces::triangle_count(std::size_t k) const {
  const SweptSurfaces& sweep = *sweeps_[k / kLevelsPerSweep];
  const std::size_t level = k % kLevelsPerSweep;
  return level < sweep.level_count() ? sweep.triangle_count(level) : 0;
}

TriangleMesh ExtractedSurfaces::take(std::size_t k) {
  SweptSurfaces& sweep = *sweeps_[k / kLevelsPerSweep];
  const std::size_t level = k % kLevelsPerSweep;
  return level < sweep.level_count() ? sweep.take(level) : TriangleMesh();
}

ExtractedSurfaces extract_surfaces(const Volume& volume, std::span<const double> values,
                                   const SurfaceStorage& storage,
                                   const ProgressCallback& progress) {
  check_values(values);
  const SweepGrid grid = make_sweep_grid(volume);
  const std::size_t sweep_count = (values.size() + kLevelsPerSweep - 1) / kLevelsPerSweep;
  ProgressMeter meter(progress, "extract", sweep_count * (grid.dims[2] - 1));
  std::vector<std::unique_ptr<SweptSurfaces>> sweeps;
  for (std::size_t first = 0; first < values.size(); first += kLevelsPerSweep) {
    const auto batch = values.subspan(first, std::min(kLevelsPerSweep, values.size() - first));
    visit_scalar_type(volume.type, [&](auto zero) {
      using T = decltype(zero);
      const auto levels = stored_levels<T>(batch, volume.slope, volume.intercept);
      sweeps.push_back(sweep<T>(volume, grid, levels, storage, meter));
    });
  }
  return {std::move(sweeps), values.size()};
}

std::vector<TriangleMesh> extract_surfaces(const Volume& volume, std::span<const double> values,
                                           const ProgressCallback& progress) {
  ExtractedSurfaces surfaces = extract_surfaces(volume, values, SurfaceStorage{}, progress);
  std::vector<TriangleMesh> meshes;
  for (std::size_t k = 0; k < surfaces.size(); ++k) meshes.push_back(surfaces.take(k));
  return meshes;
}

}  // namespace nacre

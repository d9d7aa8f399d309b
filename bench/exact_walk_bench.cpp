#include <benchmark/benchmark.h>

#include <numbers>

#include "core/volume_geometry.h"
#include "datasets/phantom.h"
#include "reference/exact_picture.h"

namespace nacre {
namespace {

constexpr int kSide = 512;
constexpr int kViews = 12;  // about the up axis, so that no view's luck decides

const Volume& angiogram() {
  static const Volume volume = make_phantom("angiogram");
  return volume;
}

/// A narrow window shows vessels only; a wide one half of the tissue.
EmissionMap window_of(const benchmark::State& state) {
  return EmissionMap::window(static_cast<double>(state.range(0)), 1400.0);
}

void exact_frame(benchmark::State& state, PictureMode mode) {
  const ExactWalk walk(angiogram(), window_of(state));
  const BoundingSphere sphere = bounding_sphere(angiogram().dims, angiogram().world_from_voxel);
  int view = 0;
  for (auto _ : state) {
    const double azimuth = 2.0 * std::numbers::pi * (view++ % kViews) / kViews;
    const Camera camera = make_camera({.size = {kSide, kSide}, .azimuth_rad = azimuth}, sphere);
    benchmark::DoNotOptimize(exact_picture(walk, camera, {.mode = mode}));
  }
  state.SetItemsProcessed(state.iterations() * kSide * kSide);  // rays a second
}
BENCHMARK_CAPTURE(exact_frame, max, PictureMode::Max)
    ->ArgName("lo")
    ->Arg(400)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(exact_frame, sum, PictureMode::Sum)
    ->ArgName("lo")
    ->Arg(400)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void exact_walk_setup(benchmark::State& state) {
  const EmissionMap emission = window_of(state);
  for (auto _ : state) benchmark::DoNotOptimize(ExactWalk(angiogram(), emission));
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(sample_count(angiogram())));
}
BENCHMARK(exact_walk_setup)->ArgName("lo")->Arg(400)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace nacre

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <array>
#include <numbers>
#include <utility>
#include <vector>

#include "bench/computing_time.h"
#include "bench/scans.h"
#include "casting/sampled_maximum.h"
#include "core/volume_geometry.h"
#include "reference/exact_picture.h"
#include "report/picture_error.h"
#include "report/picture_series.h"

namespace nacre {
namespace {

/// Exact and sampled maxima in turn, 36 views about the axis.
void exact_and_sampled(benchmark::State& state, const Scan& scan, int per_cell) {
  const Volume volume = read_scan(scan.file);
  const ExactWalk walk(volume, EmissionMap::window(scan.lo, scan.hi));
  const BoundingSphere sphere = bounding_sphere(volume.dims, volume.world_from_voxel);
  const SampledMaximum sampled(walk);
  constexpr int kFrames = 36;
  double exact_ms = 0.0;
  double sampled_ms = 0.0;
  int frame = 0;
  std::vector<Image> pictures;
  std::vector<Image> truths;
  for (auto _ : state) {
    const Camera camera = make_camera(
        {.size = {512, 512}, .azimuth_rad = 2.0 * std::numbers::pi * (frame++ % kFrames) / kFrames},
        sphere);
    Image truth;
    Image picture;
    exact_ms += computing_ms([&] {
      truth = exact_picture(walk, camera, {.mode = PictureMode::Max}).volume;
      return truth.pixels.data();
    });
    sampled_ms += computing_ms([&] {
      picture = sampled.picture(camera, {.per_cell = per_cell}).volume;
      return picture.pixels.data();
    });
    pictures.push_back(std::move(picture));
    truths.push_back(std::move(truth));
  }
  state.counters["exact_ms"] = exact_ms / frame;
  state.counters["sampled_ms"] = sampled_ms / frame;
  state.counters["ratio"] = exact_ms / sampled_ms;
  const PictureComparison error = compare_pictures(stacked(pictures), stacked(truths), 1.0);
  state.counters["lit_db"] = error.lit.psnr_db;
  state.counters["all_db"] = error.all.psnr_db;
}

/// Sampled maxima alone, by the kernel for an instruction set.
void sampled(benchmark::State& state, const Scan& scan, int per_cell, InstructionSet set) {
  const Volume volume = read_scan(scan.file);
  const ExactWalk walk(volume, EmissionMap::window(scan.lo, scan.hi));
  const BoundingSphere sphere = bounding_sphere(volume.dims, volume.world_from_voxel);
  const SampledMaximum maximum(walk);
  int frame = 0;
  for (auto _ : state) {
    const Camera camera = make_camera({.size = {512, 512}, .azimuth_rad = 0.1 * frame++}, sphere);
    benchmark::DoNotOptimize(maximum.picture(camera, {.per_cell = per_cell, .instructions = set}));
  }
}

constexpr std::array kSets{std::pair("baseline", InstructionSet::Baseline),
                           std::pair("avx2", InstructionSet::Avx2),
                           std::pair("avx512", InstructionSet::Avx512)};

void register_scans() {
  if (!has_test_data()) return;
  for (const Scan& scan : kScans) {
    for (const int samples : {1, 2, 3, 4}) {
      benchmark::RegisterBenchmark(
          fmt::format("exact_and_sampled/{}/{}", scan.name, samples).c_str(),
          [scan, samples](benchmark::State& state) { exact_and_sampled(state, scan, samples); })
          ->Iterations(36)
          ->Unit(benchmark::kMillisecond);
      for (const auto& [name, set] : kSets) {
        if (!has_instruction_set(set)) continue;
        benchmark::RegisterBenchmark(
            fmt::format("sampled/{}/{}/{}", scan.name, samples, name).c_str(),
            [scan, samples, set = set](benchmark::State& state) {
              sampled(state, scan, samples, set);
            })
            ->Unit(benchmark::kMillisecond);
      }
    }
  }
}

const bool kRegistered = (register_scans(), true);

}  // namespace
}  // namespace nacre

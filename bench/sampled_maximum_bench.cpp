#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <ctime>
#include <numbers>
#include <utility>
#include <vector>

#include "bench/scans.h"
#include "casting/sampled_maximum.h"
#include "core/volume_geometry.h"
#include "reference/exact_picture.h"

namespace nacre {
namespace {

/// PSNR over the pixels of some pictures, all and those that are lit.
struct Errors {
  double squares = 0.0;
  double pixels = 0.0;
  double lit = 0.0;

  void add(const Image& picture, const Image& truth) {
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      const double error =
          static_cast<double>(picture.pixels[i]) - static_cast<double>(truth.pixels[i]);
      squares += error * error;
      pixels += 1.0;
      lit += picture.pixels[i] > 0.0F || truth.pixels[i] > 0.0F ? 1.0 : 0.0;
    }
  }
  double psnr(double count) const { return -10.0 * std::log10(squares / count); }
};

/// Milliseconds of computing of all threads.
template <class Draw>
double computing_ms(const Draw& draw) {
  const std::clock_t begin = std::clock();
  benchmark::DoNotOptimize(draw());
  return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

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
  Errors errors;
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
    errors.add(picture, truth);
  }
  state.counters["exact_ms"] = exact_ms / frame;
  state.counters["sampled_ms"] = sampled_ms / frame;
  state.counters["ratio"] = exact_ms / sampled_ms;
  state.counters["lit_db"] = errors.psnr(errors.lit);
  state.counters["all_db"] = errors.psnr(errors.pixels);
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

#include <benchmark/benchmark.h>

#include <numbers>
#include <utility>
#include <vector>

#include "reference/shell_picture.h"
#include "reference/triangle_rays.h"
#include "tests/support/nested_shells.h"

namespace nacre {
namespace {

constexpr int kSide = 512;
constexpr int kShells = 12;
const BoundingSphere kSphere{{0.0, 0.0, 0.0}, 60.0};

Camera camera_of_view(int view) {
  return make_camera({.size = {kSide, kSide}, .azimuth_rad = 0.4 * view, .elevation_rad = 0.3},
                     kSphere);
}

std::int64_t triangle_count(const ShellSet& set) {
  std::size_t count = 0;
  for (const Shell& shell : set.shells) count += shell.surface.triangles.size();
  return static_cast<std::int64_t>(count);
}

/// Frames of nested balls, from a few large triangles to many below a pixel.
void shell_frame(benchmark::State& state, PictureMode mode, DepthCue cue) {
  const ShellSet set = testing::nested_balls(kShells, 55.0, static_cast<int>(state.range(0)));
  int view = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        shell_picture(set, camera_of_view(view++), {.mode = mode, .cue = cue}));
  }
  state.SetItemsProcessed(state.iterations() * triangle_count(set));
  state.counters["triangles"] = static_cast<double>(triangle_count(set));
}

void sweep(benchmark::internal::Benchmark* bench) {
  bench->ArgName("rings")->RangeMultiplier(4)->Range(16, 256);
  bench->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(shell_frame, max, PictureMode::Max, DepthCue{})->Apply(sweep);
BENCHMARK_CAPTURE(shell_frame, cued_max, PictureMode::Max, DepthCue{0.8, 0.2, 0.0})->Apply(sweep);
BENCHMARK_CAPTURE(shell_frame, sum, PictureMode::Sum, DepthCue{})->Apply(sweep);
BENCHMARK_CAPTURE(shell_frame, iso, PictureMode::Iso, DepthCue{})->Apply(sweep);

/// The hierarchy that tools are put into.
TriangleRays rays_of(int rings) {
  const TriangleMesh ball = testing::ball_mesh({}, 55.0, rings);
  return {{ball.positions.begin(), ball.positions.end()}, ball.triangles};
}

void hierarchy_setup(benchmark::State& state) {
  const TriangleMesh ball = testing::ball_mesh({}, 55.0, static_cast<int>(state.range(0)));
  for (auto _ : state) {
    std::vector<glm::dvec3> positions(ball.positions.begin(), ball.positions.end());
    benchmark::DoNotOptimize(TriangleRays(std::move(positions), ball.triangles));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ball.triangles.size()));
}
BENCHMARK(hierarchy_setup)->Apply(sweep);

/// One thread.
void nearest_hits(benchmark::State& state) {
  const TriangleRays rays = rays_of(static_cast<int>(state.range(0)));
  const Camera camera = camera_of_view(1);
  int pixel = 0;
  for (auto _ : state) {
    pixel = (pixel + 7919) % (kSide * kSide);
    benchmark::DoNotOptimize(
        rays.nearest(picture_ray(camera, pixel % kSide + 0.5, pixel / kSide + 0.5)));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(nearest_hits)->ArgName("rings")->RangeMultiplier(4)->Range(16, 256);

}  // namespace
}  // namespace nacre

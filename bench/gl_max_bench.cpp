#include <benchmark/benchmark.h>

#include <optional>
#include <string>

#include "core/error.h"
#include "render/gl/gl_renderer.h"
#include "tests/support/nested_shells.h"

namespace nacre {
namespace {

constexpr int kShells = 12;
const BoundingSphere kSphere{{0.0, 0.0, 0.0}, 60.0};

/// Frames of 512 x 512 pixels of nested balls, most triangles about a pixel in size.
void max_projection(benchmark::State& state, Backend backend, const RenderOptions& options) {
  std::optional<GlRenderer> renderer;
  try {
    renderer.emplace(backend);
  } catch (const Error& error) {
    state.SkipWithError(error.what());
    return;
  }
  renderer->upload(testing::nested_balls(kShells, 55.0, static_cast<int>(state.range(0))));
  const Camera camera = make_camera({.azimuth_rad = 0.4, .elevation_rad = 0.3}, kSphere);
  benchmark::DoNotOptimize(renderer->render(camera, options));  // compiles the shaders

  for (auto _ : state) benchmark::DoNotOptimize(renderer->render(camera, options));

  const auto triangles = static_cast<std::int64_t>(renderer->last_frame().triangles);
  state.SetItemsProcessed(state.iterations() * triangles);
  state.counters["triangles"] = static_cast<double>(triangles);
  state.SetLabel(renderer->info().renderer);
}

void sweep(benchmark::internal::Benchmark* bench) {
  bench->ArgName("rings")->RangeMultiplier(2)->Range(16, 256);
  bench->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(max_projection, egl, Backend::Egl, RenderOptions{})->Apply(sweep);
BENCHMARK_CAPTURE(max_projection, osmesa, Backend::OsMesa, RenderOptions{})->Apply(sweep);
BENCHMARK_CAPTURE(max_projection, osmesa_all_faces, Backend::OsMesa,
                  RenderOptions{.rules = {.cull_faces = false}})
    ->Apply(sweep);
BENCHMARK_CAPTURE(max_projection, osmesa_16_bits, Backend::OsMesa,
                  RenderOptions{.depth = DepthFormat::D16})
    ->Apply(sweep);

}  // namespace
}  // namespace nacre

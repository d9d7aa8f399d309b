#include <benchmark/benchmark.h>

#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <string>

#include "core/error.h"
#include "render/gl/gl_renderer.h"
#include "tests/support/nested_shells.h"

namespace nacre {
namespace {

constexpr int kShells = 12;
const BoundingSphere kSphere{{0.0, 0.0, 0.0}, 60.0};

const DepthCue kCue{.a = 0.7, .b = 0.3};

/// A rod of 4 r (r - 1) triangles across the shells, r = `rings`.
Tool rod(int rings) {
  Tool tool;
  tool.mesh = testing::ball_mesh({}, 1.0, rings);
  tool.world_from_tool =
      glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(10.0, -20.0, 0.0)), {60.0, 6.0, 6.0});
  return tool;
}

/// Frames of 512 x 512 pixels of nested balls.
void frames(benchmark::State& state, Backend backend, const RenderOptions& options,
            const ShellSet& set, std::span<const Tool> tools) {
  std::optional<GlRenderer> renderer;
  try {
    renderer.emplace(backend);
  } catch (const Error& error) {
    state.SkipWithError(error.what());
    return;
  }
  renderer->upload(set, {.normals = options.mode == PictureMode::Iso});
  renderer->upload_tools(tools);
  const Camera camera = make_camera({.azimuth_rad = 0.4, .elevation_rad = 0.3}, kSphere);
  benchmark::DoNotOptimize(renderer->render(camera, options));  // compiles the shaders

  for (auto _ : state) benchmark::DoNotOptimize(renderer->render(camera, options));

  const auto triangles = static_cast<std::int64_t>(renderer->last_frame().triangles);
  state.SetItemsProcessed(state.iterations() * triangles);
  state.counters["triangles"] = static_cast<double>(triangles);
  state.SetLabel(renderer->info().renderer);
}

/// Most triangles are about a pixel in size.
void max_projection(benchmark::State& state, Backend backend, const RenderOptions& options) {
  const int rings = static_cast<int>(state.range(0));
  frames(state, backend, options, testing::nested_balls(kShells, 55.0, rings), {});
}

/// 48 shells of 20,448 triangles and a tool of 27,224: the largest row of decision 012, and cued.
void tools(benchmark::State& state, const RenderOptions& options) {
  const Tool tool = rod(83);
  frames(state, Backend::OsMesa, options, testing::nested_balls(48, 55.0, 72), {&tool, 1});
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
BENCHMARK_CAPTURE(max_projection, osmesa_cued, Backend::OsMesa, RenderOptions{.cue = kCue})
    ->Apply(sweep);
BENCHMARK_CAPTURE(max_projection, osmesa_sum, Backend::OsMesa,
                  RenderOptions{.mode = PictureMode::Sum})
    ->Apply(sweep);
BENCHMARK_CAPTURE(max_projection, osmesa_count, Backend::OsMesa,
                  RenderOptions{.mode = PictureMode::Count})
    ->Apply(sweep);
BENCHMARK_CAPTURE(max_projection, osmesa_iso, Backend::OsMesa,
                  RenderOptions{.mode = PictureMode::Iso})
    ->Apply(sweep);

void in_milliseconds(benchmark::internal::Benchmark* bench) {
  bench->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(tools, passes, RenderOptions{.occlusion = Occlusion::Passes})
    ->Apply(in_milliseconds);
BENCHMARK_CAPTURE(tools, texture, RenderOptions{.occlusion = Occlusion::Texture})
    ->Apply(in_milliseconds);
BENCHMARK_CAPTURE(tools, cued_passes, RenderOptions{.cue = kCue, .occlusion = Occlusion::Passes})
    ->Apply(in_milliseconds);
BENCHMARK_CAPTURE(tools, cued_texture, RenderOptions{.cue = kCue, .occlusion = Occlusion::Texture})
    ->Apply(in_milliseconds);
BENCHMARK_CAPTURE(tools, sum, RenderOptions{.mode = PictureMode::Sum})->Apply(in_milliseconds);

}  // namespace
}  // namespace nacre

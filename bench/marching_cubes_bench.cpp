#include "extract/marching_cubes.h"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/emission.h"
#include "core/triangle_mesh.h"
#include "core/volume.h"
#include "datasets/phantom.h"
#include "extract/levels.h"
#ifdef NACRE_HAVE_VTK
#include "bench/flying_edges.h"
#endif

// Contours of phantoms, and beside them VTK's Flying Edges on the same samples and levels, where
// VTK is installed.

namespace nacre {
namespace {

/// A phantom and contour values, as the arguments `phantom` and `levels` of a bench name them.
struct Case {
  Volume volume;
  std::vector<double> values;
};

constexpr std::array<const char*, 3> kPhantoms{"angiogram", "spheres", "torus"};

Case make_case(const benchmark::State& state) {
  const char* name = kPhantoms[static_cast<std::size_t>(state.range(0))];
  double lo = 0.0;
  double hi = 1.0;
  for (const PhantomInfo& info : phantom_list()) {
    if (info.name != name) continue;
    lo = info.window_lo;
    hi = info.window_hi;
  }
  Case made{.volume = make_phantom(name), .values = {}};
  const EmissionMap window = EmissionMap::window(lo, hi);
  for (const Level& level : uniform_levels(static_cast<std::size_t>(state.range(1)))) {
    made.values.push_back(window.value_at(level.emission));
  }
  return made;
}

void count_triangles(benchmark::State& state, const Case& contoured, std::size_t triangles,
                     double area_mm2) {
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(sample_count(contoured.volume)));
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["area_mm2"] = area_mm2;
}

void marching_cubes(benchmark::State& state) {
  const Case contoured = make_case(state);
  std::vector<TriangleMesh> meshes;
  for (auto _ : state) {
    meshes = extract_surfaces(contoured.volume, contoured.values);
    benchmark::DoNotOptimize(meshes.data());
  }
  std::size_t triangles = 0;
  double area = 0.0;
  for (const TriangleMesh& mesh : meshes) {
    triangles += mesh.triangles.size();
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec3 a(mesh.positions[t.x]);
      area += 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - a,
                                           glm::dvec3(mesh.positions[t.z]) - a));
    }
  }
  count_triangles(state, contoured, triangles, area);
}

void flying_edges(benchmark::State& state) {
#ifdef NACRE_HAVE_VTK
  const Case contoured = make_case(state);
  std::vector<double> stored;
  for (const double value : contoured.values) {
    stored.push_back((value - contoured.volume.intercept) / contoured.volume.slope);
  }
  FlyingEdges peer(contoured.volume, stored);
  for (auto _ : state) peer.run();
  count_triangles(state, contoured, peer.triangle_count(), peer.area());
  state.SetLabel(FlyingEdges::version());
#else
  state.SkipWithError("built without VTK");
#endif
}

void all_cases(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"phantom", "levels"})
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MeasureProcessCPUTime();
  for (const std::int64_t levels : {1, 12, 48}) bench->Args({0, levels});
  bench->Args({1, 12})->Args({2, 12});
}

BENCHMARK(marching_cubes)->Apply(all_cases);
BENCHMARK(flying_edges)->Apply(all_cases);

}  // namespace
}  // namespace nacre

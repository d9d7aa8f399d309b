#include "extract/marching_cubes.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/scans.h"
#include "core/emission.h"
#include "core/triangle_mesh.h"
#include "core/volume.h"
#include "datasets/phantom.h"
#include "extract/levels.h"
#ifdef NACRE_HAVE_VTK
#include "bench/flying_edges.h"
#endif

// Contours of phantoms and scans, and beside them VTK's Flying Edges on the same samples and
// levels, where VTK is installed. Scans are read from the folder that NACRE_TEST_DATA names, and
// left out where it is not set.

namespace nacre {
namespace {

struct Case {
  Volume volume;
  std::vector<double> values;
};

Case make_case(Volume volume, double lo, double hi, const benchmark::State& state) {
  Case made{.volume = std::move(volume), .values = {}};
  const EmissionMap window = EmissionMap::window(lo, hi);
  for (const Level& level : uniform_levels(static_cast<std::size_t>(state.range(0)))) {
    made.values.push_back(window.value_at(level.emission));
  }
  return made;
}

Case phantom_case(const std::string& name, const benchmark::State& state) {
  const std::span<const PhantomInfo> all = phantom_list();
  const auto info =
      std::ranges::find_if(all, [&name](const PhantomInfo& one) { return one.name == name; });
  return make_case(make_phantom(name), info->window_lo, info->window_hi, state);
}

Case scan_case(const Scan& scan, const benchmark::State& state) {
  return make_case(read_scan(scan.file), scan.lo, scan.hi, state);
}

void count_triangles(benchmark::State& state, const Case& contoured, std::size_t triangles,
                     double area_mm2) {
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(sample_count(contoured.volume)));
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["area_mm2"] = area_mm2;
}

void marching_cubes(benchmark::State& state, const Case& contoured) {
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

void flying_edges(benchmark::State& state, [[maybe_unused]] const Case& contoured) {
#ifdef NACRE_HAVE_VTK
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

using MakeCase = std::function<Case(const benchmark::State&)>;

/// Both ways, for numbers of levels.
void add_benches(const std::string& name, const MakeCase& make,
                 std::initializer_list<std::int64_t> levels) {
  const auto add = [&](const std::string& way, const auto& run) {
    benchmark::internal::Benchmark* bench = benchmark::RegisterBenchmark(
        (way + "/" + name).c_str(),
        [make, run](benchmark::State& state) { run(state, make(state)); });
    bench->ArgName("levels")->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
    for (const std::int64_t count : levels) bench->Arg(count);
  };
  add("marching_cubes", marching_cubes);
  add("flying_edges", flying_edges);
}

void add_all() {
  const auto phantom = [](const std::string& name) -> MakeCase {
    return [name](const benchmark::State& state) { return phantom_case(name, state); };
  };
  add_benches("angiogram", phantom("angiogram"), {1, 12, 48});
  add_benches("spheres", phantom("spheres"), {12});
  add_benches("torus", phantom("torus"), {12});
  if (!has_test_data()) return;
  for (const Scan& scan : kScans) {
    add_benches(scan.name,
                [&scan](const benchmark::State& state) { return scan_case(scan, state); },
                {12, 48});
  }
}

}  // namespace
}  // namespace nacre

int main(int argc, char** argv) {
  nacre::add_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}

// Maximum projections and sums on the processor against what else there is: frames of 512 x 512
// pixels, 36 views about the volume, the time beside its error. Real scans are read from the folder
// that NACRE_TEST_DATA names, and left out where it is not set.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "bench/scans.h"
#include "core/error.h"
#include "core/volume_geometry.h"
#include "datasets/phantom.h"
#include "extract/levels.h"
#include "extract/marching_cubes.h"
#include "io/tool_reader.h"
#include "reference/exact_picture.h"
#include "render/cpu/cpu_renderer.h"
#include "render/gl/gl_renderer.h"
#include "report/picture_error.h"

namespace nacre {
namespace {

constexpr int kSide = 512;
constexpr int kViews = 36;

/// A volume and its window.
struct Scene {
  std::string name;
  std::string file;  ///< in the test data; empty for the phantom
  double lo = 0.0;
  double hi = 0.0;
  std::int64_t side = 256;  ///< samples of the phantom along x and y
};

Scene scene_of(const Scan& scan) { return {scan.name, scan.file, scan.lo, scan.hi}; }

/// All that the benches of a scene share, made when first needed.
class LoadedScene {
 public:
  explicit LoadedScene(const Scene& scene)
      : volume_(scene.file.empty() ? phantom(scene.side) : read_scan(scene.file)),
        emission_(EmissionMap::window(scene.lo, scene.hi)),
        walk_(volume_, emission_),
        sphere_(bounding_sphere(volume_.dims, volume_.world_from_voxel)) {
    for (int view = 0; view < kViews; ++view) {
      const double azimuth = 2.0 * std::numbers::pi * view / kViews;
      cameras_.push_back(make_camera({.size = {kSide, kSide}, .azimuth_rad = azimuth}, sphere_));
    }
  }

  const ShellSet& shells(int levels) {
    ShellSet& set = sets_[levels];
    if (!set.shells.empty()) return set;
    std::vector<double> values;
    for (const Level& level : uniform_levels(static_cast<std::size_t>(levels))) {
      values.push_back(emission_.value_at(level.emission));
      set.shells.push_back({level.emission, values.back(), level.representative, {}});
    }
    std::vector<TriangleMesh> surfaces = extract_surfaces(volume_, values);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      set.shells[i].surface = std::move(surfaces[i]);
    }
    set.center_mm = sphere_.center_mm;
    return set;
  }

  const std::vector<Image>& truth(PictureMode mode) {
    std::vector<Image>& truth = truth_[mode];
    if (truth.empty()) {
      for (const Camera& camera : cameras_) {
        truth.push_back(exact_picture(walk_, camera, {.mode = mode}).volume);
      }
    }
    return truth;
  }

  const Camera& camera(int view) const { return cameras_[static_cast<std::size_t>(view)]; }
  const ExactWalk& walk() const { return walk_; }
  const BoundingSphere& sphere() const { return sphere_; }

 private:
  static Volume phantom(std::int64_t side) {
    return make_phantom("angiogram", {.size = glm::i64vec3(side, side, side * 124 / 256)});
  }

  Volume volume_;
  EmissionMap emission_;
  ExactWalk walk_;
  BoundingSphere sphere_;
  std::vector<Camera> cameras_;
  std::map<int, ShellSet> sets_;
  std::map<PictureMode, std::vector<Image>> truth_;
};

LoadedScene& loaded(const Scene& scene) {
  static std::map<std::string, std::unique_ptr<LoadedScene>> scenes;
  std::unique_ptr<LoadedScene>& entry = scenes[scene.name];
  if (!entry) entry = std::make_unique<LoadedScene>(scene);
  return *entry;
}

/// The value that errors are stated against: 1, or the largest of all exact sums.
double peak_of(PictureMode mode, const std::vector<Image>& truth) {
  if (mode == PictureMode::Max) return 1.0;
  float peak = 0.0F;
  for (const Image& image : truth) peak = std::max(peak, *std::ranges::max_element(image.pixels));
  return peak;
}

/// Draws all views over and over, then states the error over all views together.
template <class Draw>
void frames(benchmark::State& state, LoadedScene& scene, PictureMode mode, const Draw& draw) {
  for (int view = 0; view < kViews; ++view) benchmark::DoNotOptimize(draw(scene.camera(view)));
  int view = 0;
  for (auto _ : state) benchmark::DoNotOptimize(draw(scene.camera(view++ % kViews)));
  const std::vector<Image>& truth = scene.truth(mode);
  const double peak = peak_of(mode, truth);
  double squares_all = 0.0;
  double squares_lit = 0.0;
  double all = 0.0;
  double lit = 0.0;
  for (view = 0; view < kViews; ++view) {
    const PictureComparison error =
        compare_pictures(draw(scene.camera(view)), truth[static_cast<std::size_t>(view)], peak);
    squares_all += std::pow(error.all.rmse, 2) * static_cast<double>(error.all.pixels);
    squares_lit += std::pow(error.lit.rmse, 2) * static_cast<double>(error.lit.pixels);
    all += static_cast<double>(error.all.pixels);
    lit += static_cast<double>(error.lit.pixels);
  }
  state.counters["dB_all"] = -10.0 * std::log10(squares_all / all / (peak * peak));
  state.counters["dB_lit"] = -10.0 * std::log10(squares_lit / lit / (peak * peak));
}

template <class Renderer>
void shell_frames(benchmark::State& state, const Scene& scene, int levels, PictureMode mode,
                  Renderer& renderer) {
  LoadedScene& data = loaded(scene);
  renderer.upload(data.shells(levels));
  frames(state, data, mode, [&](const Camera& camera) {
    return renderer.render(camera, RenderOptions{.mode = mode}).volume;
  });
  std::size_t triangles = 0;
  for (const Shell& shell : data.shells(levels).shells) triangles += shell.surface.triangles.size();
  state.counters["triangles"] = static_cast<double>(triangles);
}

void cpu_frames(benchmark::State& state, const Scene& scene, int levels, std::size_t threads,
                double detail_px = 0.0, PictureMode mode = PictureMode::Max) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  CpuRenderer renderer({.detail_px = detail_px});
  shell_frames(state, scene, levels, mode, renderer);
}

void gl_frames(benchmark::State& state, const Scene& scene, int levels, Backend backend,
               PictureMode mode = PictureMode::Max) {
  try {
    GlRenderer renderer(backend);
    shell_frames(state, scene, levels, mode, renderer);
  } catch (const Error& error) {
    state.SkipWithError(error.what());
  }
}

void exact_frames(benchmark::State& state, const Scene& scene,
                  PictureMode mode = PictureMode::Max) {
  LoadedScene& data = loaded(scene);
  frames(state, data, mode, [&](const Camera& camera) {
    return exact_picture(data.walk(), camera, {.mode = mode}).volume;
  });
}

/// What of the scene shows, and how: all of it, a slab of a third, or what a scalpel leaves of it.
struct Cut {
  std::string name;
  RenderOptions options;
  bool tool = false;
};

/// A surgical tool across the middle of the scene.
Tool scalpel(const LoadedScene& scene) {
  Tool tool = read_tool(test_data("tools/scalpel.stl"));
  tool.world_from_tool[3] = glm::dvec4(scene.sphere().center_mm - glm::dvec3(0, 20, -10), 1.0);
  return tool;
}

/// Frames without their errors: those of both renderers are equal.
template <class Renderer>
void cut_frames(benchmark::State& state, const Scene& scene, const Cut& cut, Renderer& renderer) {
  LoadedScene& data = loaded(scene);
  renderer.upload(data.shells(24));
  if (cut.tool) {
    const Tool tool = scalpel(data);
    renderer.upload_tools({&tool, 1});
  }
  int view = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(renderer.render(data.camera(view++ % kViews), cut.options));
  }
}

void register_bench(const std::string& name, const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

void register_scene(const Scene& scene) {
  register_bench(scene.name + "/exact", [=](auto& state) { exact_frames(state, scene); });
  for (const int levels : {6, 12, 24, 48}) {
    const std::string shells = scene.name + "/" + std::to_string(levels);
    for (const std::size_t threads : {std::size_t{1}, std::size_t{2}}) {
      register_bench(shells + "/cpu/threads:" + std::to_string(threads),
                     [=](auto& state) { cpu_frames(state, scene, levels, threads); });
    }
    register_bench(shells + "/osmesa",
                   [=](auto& state) { gl_frames(state, scene, levels, Backend::OsMesa); });
  }
}

void register_sums(const Scene& scene) {
  constexpr PictureMode kSum = PictureMode::Sum;
  register_bench(scene.name + "/sum/exact", [=](auto& state) { exact_frames(state, scene, kSum); });
  for (const int levels : {12, 24, 48}) {
    const std::string shells = scene.name + "/sum/" + std::to_string(levels);
    for (const std::size_t threads : {std::size_t{1}, std::size_t{2}}) {
      register_bench(shells + "/cpu/threads:" + std::to_string(threads),
                     [=](auto& state) { cpu_frames(state, scene, levels, threads, 0.0, kSum); });
    }
    register_bench(shells + "/osmesa",
                   [=](auto& state) { gl_frames(state, scene, levels, Backend::OsMesa, kSum); });
  }
}

void register_cuts(const Scene& scene) {
  const Slab slab{.near_mm = -20.0, .far_mm = 15.0};
  const DepthCue cue{.a = 0.8, .b = 0.2};
  const std::vector<Cut> cuts{{"whole", {}},
                              {"slab", {.slab = slab}},
                              {"tool", {}, true},
                              {"tool+slab+cue", {.cue = cue, .slab = slab}, true},
                              {"count", {.mode = PictureMode::Count}},
                              {"sum", {.mode = PictureMode::Sum}},
                              {"sum+cue", {.mode = PictureMode::Sum, .cue = cue}},
                              {"sum+slab", {.mode = PictureMode::Sum, .slab = slab}},
                              {"sum+tool", {.mode = PictureMode::Sum}, true}};
  for (const Cut& cut : cuts) {
    const std::string name = scene.name + "/cut:" + cut.name;
    register_bench(name + "/cpu", [=](benchmark::State& state) {
      CpuRenderer renderer;
      cut_frames(state, scene, cut, renderer);
    });
    register_bench(name + "/osmesa", [=](benchmark::State& state) {
      GlRenderer renderer(Backend::OsMesa);
      cut_frames(state, scene, cut, renderer);
    });
  }
}

/// The same anatomy sampled ever more finely, in pictures of one size: cost against work.
void register_growing() {
  for (const std::int64_t side : {112, 256, 384, 512, 640, 768}) {
    const Scene scene{"growing/" + std::to_string(side), "", 400.0, 1400.0, side};
    for (const double detail_px : {0.0, 1.0, 1.5, 2.0}) {
      register_bench(scene.name + "/detail:" + std::to_string(detail_px).substr(0, 3),
                     [=](auto& state) { cpu_frames(state, scene, 24, 2, detail_px); });
    }
  }
}

}  // namespace
}  // namespace nacre

int main(int argc, char** argv) {
  nacre::register_scene({"phantom", "", 400.0, 1400.0});
  if (nacre::has_test_data()) {
    for (const nacre::Scan& scan : nacre::kScans) nacre::register_scene(nacre::scene_of(scan));
    nacre::register_sums(nacre::scene_of(nacre::kHeadScan));
    nacre::register_cuts(nacre::scene_of(nacre::kHeadScan));
  }
  nacre::register_growing();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <ctime>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "bench/computing_time.h"
#include "bench/scans.h"
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

constexpr DepthCue kNone{};
constexpr DepthCue kNearer{0.8, 0.2, 0.0};    // brighter towards the eye
constexpr DepthCue kFarther{-0.8, 1.0, 0.0};  // the other way
constexpr DepthCue kBehind{0.6, 0.4, 0.0};    // of decision 020

/// N uniform levels of a window.
std::vector<ShownLevel> levels_of(const EmissionMap& emission, int count) {
  std::vector<ShownLevel> levels;
  for (int k = 1; k <= count; ++k) {
    levels.push_back({emission.value_at((k - 0.5) / count), static_cast<double>(k) / count});
  }
  return levels;
}

template <class Draw>
void time_frames(benchmark::State& state, const Draw& draw) {
  const BoundingSphere sphere = bounding_sphere(angiogram().dims, angiogram().world_from_voxel);
  int view = 0;
  for (auto _ : state) {
    const double azimuth = 2.0 * std::numbers::pi * (view++ % kViews) / kViews;
    benchmark::DoNotOptimize(
        draw(make_camera({.size = {kSide, kSide}, .azimuth_rad = azimuth}, sphere)));
  }
  state.SetItemsProcessed(state.iterations() * kSide * kSide);  // rays a second
}

/// On the clock, with the computing time of all threads beside it.
void as_frames(benchmark::internal::Benchmark* frames) {
  frames->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

void exact_frame(benchmark::State& state, PictureMode mode, DepthCue cue) {
  const ExactWalk walk(angiogram(), window_of(state));
  time_frames(state, [&](const Camera& camera) {
    return exact_picture(walk, camera, {.mode = mode, .cue = cue});
  });
}
BENCHMARK_CAPTURE(exact_frame, max, PictureMode::Max, kNone)
    ->ArgName("lo")
    ->Arg(400)
    ->Arg(100)
    ->Apply(as_frames);
BENCHMARK_CAPTURE(exact_frame, max_nearer, PictureMode::Max, kNearer)
    ->ArgName("lo")
    ->Arg(400)
    ->Arg(100)
    ->Apply(as_frames);
BENCHMARK_CAPTURE(exact_frame, max_farther, PictureMode::Max, kFarther)
    ->ArgName("lo")
    ->Arg(400)
    ->Apply(as_frames);
BENCHMARK_CAPTURE(exact_frame, sum, PictureMode::Sum, kNone)
    ->ArgName("lo")
    ->Arg(400)
    ->Arg(100)
    ->Apply(as_frames);
BENCHMARK_CAPTURE(exact_frame, sum_nearer, PictureMode::Sum, kNearer)
    ->ArgName("lo")
    ->Arg(400)
    ->Arg(100)
    ->Apply(as_frames);

/// A maximum ray by ray, in scalar double: what the picture by cells is compared with.
Image maximum_by_rays(const ExactWalk& walk, const Camera& camera, DepthCue cue) {
  Image image = make_image(kSide, kSide);
  const CueField field = cue_field(cue, camera);
  tbb::parallel_for(tbb::blocked_range2d<int>(0, kSide, 16, 0, kSide, 16), [&](const auto& tile) {
    for (int y = tile.rows().begin(); y != tile.rows().end(); ++y) {
      for (int x = tile.cols().begin(); x != tile.cols().end(); ++x) {
        const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
        image.at(x, y) =
            static_cast<float>(walk.max_emission(ray, visible_interval(camera, ray, {}), field));
      }
    }
  });
  return image;
}

void rays_frame(benchmark::State& state, DepthCue cue) {
  const ExactWalk walk(angiogram(), window_of(state));
  time_frames(state, [&](const Camera& camera) { return maximum_by_rays(walk, camera, cue); });
}
BENCHMARK_CAPTURE(rays_frame, max, kNone)->ArgName("lo")->Arg(400)->Arg(100)->Apply(as_frames);
BENCHMARK_CAPTURE(rays_frame, max_nearer, kNearer)
    ->ArgName("lo")
    ->Arg(400)
    ->Arg(100)
    ->Apply(as_frames);

/// Ideal shells of the narrow window.
void ideal_frame(benchmark::State& state, PictureMode mode) {
  const EmissionMap emission = EmissionMap::window(400.0, 1400.0);
  const ExactWalk walk(angiogram(), emission);
  const std::vector<ShownLevel> levels = levels_of(emission, static_cast<int>(state.range(0)));
  time_frames(state, [&](const Camera& camera) {
    return ideal_picture(walk, camera, {.mode = mode, .cue = kNearer, .levels = levels});
  });
}
BENCHMARK_CAPTURE(ideal_frame, max, PictureMode::Max)
    ->ArgName("levels")
    ->Arg(24)
    ->Arg(200)
    ->Apply(as_frames);
BENCHMARK_CAPTURE(ideal_frame, sum, PictureMode::Sum)
    ->ArgName("levels")
    ->Arg(24)
    ->Arg(200)
    ->Apply(as_frames);
BENCHMARK_CAPTURE(ideal_frame, count, PictureMode::Count)
    ->ArgName("levels")
    ->Arg(24)
    ->Apply(as_frames);
BENCHMARK_CAPTURE(ideal_frame, iso, PictureMode::Iso)->ArgName("levels")->Arg(1)->Apply(as_frames);

void exact_walk_setup(benchmark::State& state) {
  const EmissionMap emission = window_of(state);
  for (auto _ : state) benchmark::DoNotOptimize(ExactWalk(angiogram(), emission));
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(sample_count(angiogram())));
}
BENCHMARK(exact_walk_setup)->ArgName("lo")->Arg(400)->Unit(benchmark::kMillisecond)->UseRealTime();

/// A window of a scan, and the elevation that it is seen from.
struct SeenScan {
  Scan scan;
  const char* view;
  double elevation_rad = 0.0;
};

/// Milliseconds of computing that a frame takes by rays and by cells, one after the other.
class CellsAndRays {
 public:
  CellsAndRays(const SeenScan& seen, DepthCue cue)
      : volume_(read_scan(seen.scan.file)),
        walk_(volume_, EmissionMap::window(seen.scan.lo, seen.scan.hi)),
        elevation_rad_(seen.elevation_rad),
        cue_(cue) {}

  void time(benchmark::State& state) const {
    constexpr int kFrames = 36;
    double by_cells = 0.0;
    double by_rays = 0.0;
    int frame = 0;
    for (auto _ : state) {
      const Camera camera =
          make_camera({.size = {kSide, kSide},
                       .azimuth_rad = 2.0 * std::numbers::pi * (frame++ % kFrames) / kFrames,
                       .elevation_rad = elevation_rad_},
                      bounding_sphere(volume_.dims, volume_.world_from_voxel));
      by_cells += computing_ms(
          [&] { return exact_picture(walk_, camera, {.mode = PictureMode::Max, .cue = cue_}); });
      by_rays += computing_ms([&] { return maximum_by_rays(walk_, camera, cue_); });
    }
    state.counters["cells_ms"] = by_cells / frame;
    state.counters["rays_ms"] = by_rays / frame;
    state.counters["ratio"] = by_rays / by_cells;
  }

 private:
  Volume volume_;
  ExactWalk walk_;
  double elevation_rad_;
  DepthCue cue_;
};

/// The rows of decision 020.
void register_scans() {
  const SeenScan others[] = {{{kHeadScan.name, kHeadScan.file, 5.0, 60.0}, "wide"},
                             {kHeadScan, "from above", std::numbers::pi / 3.0}};
  std::vector<SeenScan> all;
  for (const Scan& scan : kScans) all.push_back({scan, "about the axis"});
  all.insert(all.end(), std::begin(others), std::end(others));
  for (const SeenScan& seen : all) {
    for (const auto& [name, cue] : {std::pair("max", kNone), std::pair("cued", kBehind)}) {
      const std::string title = fmt::format("cells_and_rays/{}/{},{}/{}/{}", seen.scan.name,
                                            seen.scan.lo, seen.scan.hi, seen.view, name);
      benchmark::RegisterBenchmark(
          title.c_str(),
          [seen, cue = cue](benchmark::State& state) { CellsAndRays(seen, cue).time(state); })
          ->Iterations(36)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    }
  }
}

}  // namespace
}  // namespace nacre

int main(int argc, char** argv) {
  if (nacre::has_test_data()) nacre::register_scans();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

// Maxima estimated between the levels: the pictures that ideal shells would show, 512 x 512, one
// thread.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "core/dequantization.h"
#include "core/volume_geometry.h"
#include "datasets/phantom.h"
#include "reference/exact_picture.h"

namespace nacre {
namespace {

constexpr int kSide = 512;

Image exact_maximum() {
  const Volume volume = make_phantom("angiogram");
  const EmissionMap emission = EmissionMap::window(660.0, 1201.0);
  const ExactWalk walk(volume, emission);
  const Camera camera = make_camera({.size = {kSide, kSide}, .azimuth_rad = 0.5},
                                    bounding_sphere(volume.dims, volume.world_from_voxel));
  return exact_picture(walk, camera, {.mode = PictureMode::Max}).volume;
}

void smooth_layers(benchmark::State& state) {
  static const Image exact = exact_maximum();
  const auto levels = static_cast<int>(state.range(0));
  std::vector<LayerLevel> list;
  for (int k = 1; k <= levels; ++k) list.push_back({(k - 0.5) / levels, 1.0 * k / levels});
  const std::vector<LayerRange> layers = layer_ranges(list);
  Image flat = exact;
  for (float& pixel : flat.pixels) {
    const auto above = std::find_if(layers.rbegin(), layers.rend(),
                                    [&](const LayerRange& layer) { return pixel >= layer.lo; });
    pixel = above->shown;
  }
  for (auto _ : state) {
    state.PauseTiming();
    Image picture = flat;
    state.ResumeTiming();
    dequantize(picture, layers);
    benchmark::DoNotOptimize(picture.pixels.data());
  }
  state.SetItemsProcessed(state.iterations() * kSide * kSide);
}
BENCHMARK(smooth_layers)->Arg(6)->Arg(12)->Arg(48)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace nacre

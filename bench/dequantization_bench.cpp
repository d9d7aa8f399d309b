// Maxima estimated between the levels: the pictures that ideal shells would show, 512 x 512, one
// thread.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "core/dequantization.h"
#include "core/volume_geometry.h"
#include "datasets/phantom.h"
#include "reference/exact_picture.h"

namespace nacre {
namespace {

constexpr int kSide = 512;

Image exact_maximum(int side) {
  const Volume volume = make_phantom("angiogram");
  const EmissionMap emission = EmissionMap::window(660.0, 1201.0);
  const ExactWalk walk(volume, emission);
  const Camera camera = make_camera({.size = {side, side}, .azimuth_rad = 0.5},
                                    bounding_sphere(volume.dims, volume.world_from_voxel));
  return exact_picture(walk, camera, {.mode = PictureMode::Max}).volume;
}

/// As many levels as the first argument says, the second's square of rays a pixel.
void estimate(benchmark::State& state) {
  const auto levels = static_cast<int>(state.range(0));
  const auto per_pixel = static_cast<int>(state.range(1));
  const Image exact = exact_maximum(per_pixel * kSide);
  std::vector<LayerLevel> list;
  for (int k = 1; k <= levels; ++k) list.push_back({(k - 0.5) / levels, 1.0 * k / levels});
  const std::vector<LayerRange> layers = layer_ranges(list);
  std::vector<std::uint8_t> ranks;
  for (const float pixel : exact.pixels) {
    ranks.push_back(static_cast<std::uint8_t>(pixel * static_cast<float>(levels) + 0.5F));
  }
  const LayerSamples<std::uint8_t> samples{kSide, kSide, per_pixel, ranks};
  Image picture;
  for (auto _ : state) {
    dequantize(samples, layers, {}, {}, picture);
    benchmark::DoNotOptimize(picture.pixels.data());
  }
  state.SetItemsProcessed(state.iterations() * kSide * kSide);
}
BENCHMARK(estimate)->ArgsProduct({{6, 12, 48}, {1, 3}})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace nacre

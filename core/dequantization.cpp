#include "core/dequantization.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "core/layer_filter.h"
#include "core/layer_samples.h"

namespace nacre {
namespace {

using layers::filter_of;
using layers::kBlock;
using layers::kClasses;
using layers::kReach;
using layers::Neighbourhood;
using layers::Occupancy;
using layers::SumOf;

/// Bins that a layer is looked up in.
constexpr int kBins = 1024;

void serial(int count, const std::function<void(int)>& row) {
  for (int i = 0; i < count; ++i) row(i);
}

/// The layer that a value is the representative of, or lies in.
class LayerLookup {
 public:
  explicit LayerLookup(std::span<const LayerRange> layers) : layers_(layers) {
    std::uint32_t layer = 0;
    for (int bin = 0; bin < kBins; ++bin) {
      while (layer < layers.size() && bin_of(layers[layer].shown) < bin) ++layer;
      first_[static_cast<std::size_t>(bin)] = layer;
    }
  }

  std::size_t rank_of(float value) const {
    if (!(value > 0.0F)) return 0;
    std::size_t layer = first_[static_cast<std::size_t>(bin_of(value))];
    while (layer < layers_.size() && layers_[layer].shown < value) ++layer;
    if (layer < layers_.size() && layers_[layer].shown == value) return layer;
    // Between two representatives.
    layer = std::min(layer, layers_.size() - 1);
    while (layer > 0 && layers_[layer].lo > value) --layer;
    return layer;
  }

 private:
  static int bin_of(float value) {
    return static_cast<int>(std::clamp(value, 0.0F, 1.0F) * static_cast<float>(kBins - 1));
  }

  std::span<const LayerRange> layers_;
  std::array<std::uint32_t, kBins> first_{};
};

/// What a layer's pixels show from half a layer below to half a layer above.
struct LayerSlopes {
  float shown;
  float below;  ///< emission a layer
  float above;
};

/// What a row is estimated to be.
template <class Rank>
class RowEstimate {
 public:
  RowEstimate(const LayerSamples<Rank>& samples, const Occupancy<Rank>& occupancy,
              const LayerFilter& filter, std::span<const LayerRange> layers)
      : samples_(samples), occupancy_(occupancy), stride_(filter.stride) {
    for (std::size_t i = 0; i < kClasses; ++i) {
      weights_[i] = static_cast<float>(filter.weights[i]);
    }
    for (const LayerRange& layer : layers) {
      slopes_.push_back(
          {layer.shown, 2.0F * (layer.shown - layer.lo), 2.0F * (layer.hi - layer.shown)});
    }
  }

  void write(const std::uint8_t* fixed, int y, float* out) const {
    Neighbourhood<Rank> around(samples_, stride_, y);
    for (int block = 0; block < occupancy_.blocks(); ++block) {
      const int x = block * kBlock;
      const int count = std::min(kBlock, samples_.width - x);
      if (shows_near(block, y)) {
        around.fill(x, x + count);
        write_block(around, fixed == nullptr ? nullptr : fixed + x, x, count, out + x);
      } else {
        std::fill_n(out + x, count, slopes_[0].shown);
      }
    }
  }

 private:
  bool shows_near(int block, int y) const {
    const int rows = samples_.height * samples_.per_pixel;
    for (int step = -kReach; step <= kReach; ++step) {
      const int row = y * samples_.per_pixel + samples_.per_pixel / 2 + step * stride_;
      if (occupancy_.shows_about(block, std::clamp(row, 0, rows - 1))) return true;
    }
    return false;
  }

  void write_block(const Neighbourhood<Rank>& around, const std::uint8_t* fixed, int x, int count,
                   float* out) const {
    std::array<std::array<SumOf<Rank>, kBlock>, kClasses> differences{};
    around.differences(x, count, differences);
    std::array<float, kBlock> change{};
    for (std::size_t c = 0; c < kClasses; ++c) {
      for (std::size_t i = 0; i < kBlock; ++i) {
        change[i] += weights_[c] * static_cast<float>(differences[c][i]);
      }
    }
    const auto* center = around.center() + x;
    for (int i = 0; i < count; ++i) {
      const auto rank = static_cast<std::size_t>(center[i]);
      const LayerSlopes& layer = slopes_[rank];
      float moved = std::clamp(change[static_cast<std::size_t>(i)], -0.5F, 0.5F);
      if (rank == 0 && fixed != nullptr && fixed[i] != 0) moved = 0.0F;
      out[i] = layer.shown + moved * (moved < 0.0F ? layer.below : layer.above);
    }
  }

  const LayerSamples<Rank>& samples_;
  const Occupancy<Rank>& occupancy_;
  int stride_;
  std::array<float, kClasses> weights_{};
  std::vector<LayerSlopes> slopes_;
};

/// The layers of all samples.
template <class Rank>
void find_ranks(const Image& samples, const LayerLookup& lookup, const RowLoop& rows,
                std::vector<Rank>& ranks) {
  ranks.resize(samples.pixels.size());
  rows(samples.height, [&](int y) {
    const auto first = static_cast<std::size_t>(y) * static_cast<std::size_t>(samples.width);
    float before = 0.0F;
    Rank rank = 0;
    for (std::size_t i = first; i < first + static_cast<std::size_t>(samples.width); ++i) {
      if (samples.pixels[i] != before) {  // most are as the sample before them
        before = samples.pixels[i];
        rank = static_cast<Rank>(lookup.rank_of(before));
      }
      ranks[i] = rank;
    }
  });
}

/// @param ranks  memory
template <class Rank>
void dequantize_image(const Image& samples, int per_pixel, std::span<const LayerRange> layers,
                      std::span<const std::uint8_t> fixed, const RowLoop& rows,
                      std::vector<Rank>& ranks, Image& maximum) {
  find_ranks(samples, LayerLookup(layers), rows, ranks);
  const LayerSamples<Rank> of_layers{samples.width / per_pixel, samples.height / per_pixel,
                                     per_pixel, ranks};
  dequantize(of_layers, layers, fixed, rows, maximum);
  const int middle = per_pixel / 2;
  rows(maximum.height, [&](int y) {
    for (int x = 0; x < maximum.width; ++x) {
      const auto sample = static_cast<std::size_t>(y * per_pixel + middle) *
                              static_cast<std::size_t>(samples.width) +
                          static_cast<std::size_t>(x * per_pixel + middle);
      const float shown = samples.pixels[sample];
      if (shown != layers[ranks[sample]].shown) maximum.at(x, y) = shown;
    }
  });
}

}  // namespace

std::vector<LayerRange> layer_ranges(std::span<const LayerLevel> levels, double factor) {
  const auto most = static_cast<float>(factor);
  std::vector<LayerRange> layers{{0.0F, 0.0F, most}};
  for (const LayerLevel& level : levels) {
    const auto emission = static_cast<float>(factor * level.emission);
    const auto shown = static_cast<float>(factor * level.representative);
    if (shown == layers.back().shown) continue;
    layers.back().hi = emission;
    layers.push_back({emission, shown, most});
  }
  const bool contained = std::all_of(layers.begin(), layers.end(), [](const LayerRange& layer) {
    return layer.lo <= layer.shown && layer.shown <= layer.hi;
  });
  if (!contained) layers.clear();
  return layers;
}

template <class Rank>
LayerFilter layer_filter(const LayerSamples<Rank>& samples, const RowLoop& rows) {
  const RowLoop& loop = rows ? rows : serial;
  return filter_of(samples, Occupancy<Rank>(samples, loop), loop);
}

template <class Rank>
void dequantize(const LayerSamples<Rank>& samples, std::span<const LayerRange> layers,
                std::span<const std::uint8_t> fixed, const RowLoop& rows, Image& maximum) {
  const RowLoop& loop = rows ? rows : serial;
  maximum.width = samples.width;
  maximum.height = samples.height;
  maximum.pixels.resize(static_cast<std::size_t>(samples.width) *
                        static_cast<std::size_t>(samples.height));
  const Occupancy<Rank> occupancy(samples, loop);
  const RowEstimate<Rank> estimate(samples, occupancy, filter_of(samples, occupancy, loop), layers);
  loop(samples.height, [&](int y) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(samples.width) * y;
    estimate.write(fixed.empty() ? nullptr : fixed.data() + first, y,
                   maximum.pixels.data() + first);
  });
}

template LayerFilter layer_filter(const LayerSamples<std::uint8_t>&, const RowLoop&);
template LayerFilter layer_filter(const LayerSamples<std::uint16_t>&, const RowLoop&);
template void dequantize(const LayerSamples<std::uint8_t>&, std::span<const LayerRange>,
                         std::span<const std::uint8_t>, const RowLoop&, Image&);
template void dequantize(const LayerSamples<std::uint16_t>&, std::span<const LayerRange>,
                         std::span<const std::uint8_t>, const RowLoop&, Image&);

void dequantize(const Image& samples, int per_pixel, std::span<const LayerRange> layers,
                std::span<const std::uint8_t> fixed, const RowLoop& rows,
                DequantizationMemory& memory, Image& maximum) {
  const RowLoop& loop = rows ? rows : serial;
  if (layers.size() <= std::numeric_limits<std::uint8_t>::max() + 1U) {
    dequantize_image(samples, per_pixel, layers, fixed, loop, memory.bytes, maximum);
  } else {
    dequantize_image(samples, per_pixel, layers, fixed, loop, memory.words, maximum);
  }
}

void dequantize(Image& maximum, std::span<const LayerRange> layers,
                std::span<const std::uint8_t> fixed, const RowLoop& rows) {
  DequantizationMemory memory;
  Image result;
  dequantize(maximum, 1, layers, fixed, rows, memory, result);
  maximum = std::move(result);
}

Image middle_samples(const Image& samples, int per_pixel) {
  Image picture = make_image(samples.width / per_pixel, samples.height / per_pixel);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      picture.at(x, y) = samples.at(x * per_pixel + per_pixel / 2, y * per_pixel + per_pixel / 2);
    }
  }
  return picture;
}

}  // namespace nacre

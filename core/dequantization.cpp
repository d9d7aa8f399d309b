#include "core/dequantization.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/layer_samples.h"

namespace nacre {
namespace {

using layers::kBlock;
using layers::kClasses;
using layers::kMaxStride;
using layers::kReach;
using layers::Neighbourhood;
using layers::Occupancy;
using layers::SumOf;

/// Mean squared difference of neighbours, in squared layers, up to which steps are made wider: what
/// quantising leaves of samples in the same layer is the same.
constexpr double kAlike = 0.3;
/// Variance of errors that contours and simplifying leave in each class's sum of differences, in
/// squared layers. Without it, weights would grow beyond measure along straight vessels.
constexpr double kOtherErrors = 0.2;
/// Rows that covariances are taken from, at even distances.
constexpr int kSampledRows = 128;
/// Bins that a layer is looked up in.
constexpr int kBins = 1024;

/// A neighbour, and the class it belongs to.
struct Offset {
  int x;
  int y;
  std::size_t index;
};

/// Those beside and below; the others lie opposite.
constexpr std::array<Offset, 12> kOffsets{{{1, 0, 0},
                                           {0, 1, 0},
                                           {1, 1, 1},
                                           {-1, 1, 1},
                                           {2, 0, 2},
                                           {0, 2, 2},
                                           {2, 1, 3},
                                           {-2, 1, 3},
                                           {1, 2, 3},
                                           {-1, 2, 3},
                                           {2, 2, 4},
                                           {-2, 2, 4}}};

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

/// Sums over pixels that show a shell.
struct Statistics {
  std::array<std::array<double, kClasses>, kClasses> products{};  ///< of the classes' differences
  std::array<double, kOffsets.size()> squares{};                  ///< of single differences
  double pixels = 0.0;

  void add(const Statistics& other) {
    for (std::size_t i = 0; i < kClasses; ++i) {
      for (std::size_t j = 0; j < kClasses; ++j) products[i][j] += other.products[i][j];
    }
    for (std::size_t i = 0; i < squares.size(); ++i) squares[i] += other.squares[i];
    pixels += other.pixels;
  }
};

/// Of some pixels, those that show nothing counted as 0.
template <class Sum>
double sum_of_products(const Sum* a, const Sum* b, const Sum* center, int count) {
  // Differences of layers are whole numbers, and so are their sums: the same in any order.
  std::int64_t sum = 0;
  for (int i = 0; i < count; ++i) {
    const std::int64_t product = std::int64_t{a[i]} * b[i];
    sum += center[i] > 0 ? product : 0;
  }
  return static_cast<double>(sum);
}

template <class Rank>
Statistics statistics_of_row(const LayerSamples<Rank>& samples, const Occupancy<Rank>& occupancy,
                             int stride, int y) {
  using Sum = SumOf<Rank>;
  Neighbourhood<Rank> around(samples, stride, y, true);
  const int middle = y * samples.per_pixel + samples.per_pixel / 2;
  std::array<std::array<Sum, kBlock>, kClasses> differences;
  std::array<Sum, kBlock> difference;
  Statistics sums;
  for (int block = 0; block < occupancy.blocks(); ++block) {
    if (!occupancy.shows(block, middle)) continue;
    const int x = block * kBlock;
    const int count = std::min(kBlock, samples.width - x);
    around.fill(x, x + count);
    const Sum* center = around.center() + x;
    around.differences(x, count, differences);
    for (std::size_t i = 0; i < kClasses; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        sums.products[i][j] +=
            sum_of_products(differences[i].data(), differences[j].data(), center, count);
      }
    }
    for (std::size_t i = 0; i < kOffsets.size(); ++i) {
      const Sum* there = around.neighbour(kOffsets[i].x, kOffsets[i].y) + x;
      for (int k = 0; k < count; ++k) {
        difference[static_cast<std::size_t>(k)] = static_cast<Sum>(there[k] - center[k]);
      }
      sums.squares[i] += sum_of_products(difference.data(), difference.data(), center, count);
    }
    sums.pixels +=
        static_cast<double>(std::count_if(center, center + count, [](Sum c) { return c > 0; }));
  }
  return sums;
}

template <class Rank>
Statistics statistics_of(const LayerSamples<Rank>& samples, const Occupancy<Rank>& occupancy,
                         int stride, const RowLoop& rows) {
  const int step = std::max(samples.height / kSampledRows, 1);
  const int sampled = (samples.height + step - 1) / step;
  std::vector<Statistics> of_rows(static_cast<std::size_t>(sampled));
  rows(sampled, [&](int i) {
    of_rows[static_cast<std::size_t>(i)] = statistics_of_row(samples, occupancy, stride, i * step);
  });
  Statistics all;
  for (const Statistics& row : of_rows) all.add(row);
  for (std::size_t i = 0; i < kClasses; ++i) {
    for (std::size_t j = 0; j < i; ++j) all.products[j][i] = all.products[i][j];
  }
  return all;
}

/// -E[(k(n) - k(p)) u(p)], u what quantising leaves, where the neighbour's mean squared difference
/// is that (docs/derivations.md, 3.5).
double covariance_with_error(double mean_square) {
  constexpr double kVariance = 1.0 / 12.0;
  if (!(mean_square < 0.5)) return kVariance;
  return std::min(kVariance, 0.5 * mean_square * (1.0 - mean_square));
}

/// Solves for the weights by Cholesky's factors.
std::array<double, kClasses> solve(std::array<std::array<double, kClasses>, kClasses> a,
                                   std::array<double, kClasses> b) {
  for (std::size_t i = 0; i < kClasses; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = a[i][j];
      for (std::size_t k = 0; k < j; ++k) rest -= a[i][k] * a[j][k];
      if (i == j && !(rest > 0.0)) return {};
      a[i][j] = i == j ? std::sqrt(rest) : rest / a[j][j];
    }
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  for (std::size_t i = kClasses; i-- > 0;) {
    for (std::size_t k = i + 1; k < kClasses; ++k) b[i] -= a[k][i] * b[k];
    b[i] /= a[i][i];
  }
  return b;
}

/// All 0 where nothing is to be told.
std::array<double, kClasses> weights_of(const Statistics& sums) {
  if (!(sums.pixels > 0.0)) return {};
  std::array<std::array<double, kClasses>, kClasses> left = sums.products;
  std::array<double, kClasses> right{};
  for (std::size_t i = 0; i < kClasses; ++i) left[i][i] += kOtherErrors * sums.pixels;
  for (std::size_t i = 0; i < kOffsets.size(); ++i) {  // each stands for the opposite one as well
    right[kOffsets[i].index] +=
        2.0 * sums.pixels * covariance_with_error(sums.squares[i] / sums.pixels);
  }
  return solve(left, right);
}

/// Of the next samples beside and below.
double mean_square(const Statistics& sums) {
  return sums.pixels > 0.0 ? 0.5 * (sums.squares[0] + sums.squares[1]) / sums.pixels : 1.0;
}

/// 1, 2, 3, 4, 6, 8, 12, 16, 24, ...
int wider_than(int stride) {
  const bool is_power_of_two = (stride & (stride - 1)) == 0;
  return is_power_of_two ? std::max(stride + stride / 2, stride + 1) : stride / 3 * 4;
}

template <class Rank>
LayerFilter filter_of(const LayerSamples<Rank>& samples, const Occupancy<Rank>& occupancy,
                      const RowLoop& rows) {
  Statistics sums = statistics_of(samples, occupancy, 1, rows);
  int stride = 1;
  for (int next = 2; next <= kMaxStride * samples.per_pixel; next = wider_than(stride)) {
    // Differences grow at least as the distance does.
    if (mean_square(sums) * next > kAlike * stride) break;
    const Statistics wider = statistics_of(samples, occupancy, next, rows);
    if (mean_square(wider) > kAlike) break;
    stride = next;
    sums = wider;
  }
  return {stride, weights_of(sums)};
}

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

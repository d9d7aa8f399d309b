#include "core/dequantization.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace nacre {
namespace {

constexpr std::size_t kClasses = 5;
constexpr int kReach = 2;  ///< steps
constexpr int kMaxStride = 16;
/// Pixels are looked at in blocks, those far from any shell not at all.
constexpr int kBlock = kReach * kMaxStride;
/// Pixels side by side.
using Lanes [[gnu::vector_size(16)]] = float;
constexpr int kLanes = 4;
static_assert(kBlock % kLanes == 0);
/// Mean squared difference of neighbours, in squared layers, from which on what quantising leaves
/// of them is taken as independent.
constexpr double kIndependent = 0.25;
/// Rows that covariances are taken from, at even distances.
constexpr int kSampledRows = 128;
/// Bins that a layer is looked up in.
constexpr int kBins = 1024;

void serial(int count, const std::function<void(int)>& row) {
  for (int i = 0; i < count; ++i) row(i);
}

void run(const RowLoop& rows, int count, const std::function<void(int)>& row) {
  rows ? rows(count, row) : serial(count, row);
}

Lanes load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

/// 1 where above 0.
Lanes shows(const Lanes& value) { return value > 0.0F ? Lanes{} + 1.0F : Lanes{}; }

double sum_of(const Lanes& lanes) {
  return (double{lanes[0]} + double{lanes[1]}) + (double{lanes[2]} + double{lanes[3]});
}

/// The layer that a value is the representative of.
class LayerLookup {
 public:
  explicit LayerLookup(std::span<const LayerRange> layers) : layers_(layers) {
    std::uint32_t layer = 0;
    for (int bin = 0; bin < kBins; ++bin) {
      while (layer < layers.size() && bin_of(layers[layer].shown) < bin) ++layer;
      first_[static_cast<std::size_t>(bin)] = layer;
    }
  }

  /// nullptr: of none.
  const LayerRange* find(float value) const {
    std::size_t layer = first_[static_cast<std::size_t>(bin_of(value))];
    while (layer < layers_.size() && layers_[layer].shown < value) ++layer;
    return layer < layers_.size() && layers_[layer].shown == value ? &layers_[layer] : nullptr;
  }

 private:
  static int bin_of(float value) {
    return static_cast<int>(std::clamp(value, 0.0F, 1.0F) * static_cast<float>(kBins - 1));
  }

  std::span<const LayerRange> layers_;
  std::array<std::uint32_t, kBins> first_{};
};

const float* row_of(const Image& image, int y) {
  return image.pixels.data() + static_cast<std::ptrdiff_t>(image.width) * y;
}

/// Which blocks of each row show a shell.
class Occupancy {
 public:
  Occupancy(const Image& image, const RowLoop& rows)
      : blocks_((image.width + kBlock - 1) / kBlock),
        shows_(static_cast<std::size_t>(blocks_) * static_cast<std::size_t>(image.height)) {
    run(rows, image.height, [&](int y) {
      const float* row = row_of(image, y);
      for (int block = 0; block < blocks_; ++block) {
        const int end = std::min((block + 1) * kBlock, image.width);
        int x = block * kBlock;
        Lanes sum{};
        for (; x + kLanes <= end; x += kLanes) sum += load(row + x);
        bool any = sum_of(sum) > 0.0;
        for (; x < end; ++x) any = any || row[x] > 0.0F;
        shows_[index(block, y)] = any ? 1 : 0;
      }
    });
  }

  int blocks() const { return blocks_; }

  bool shows(int block, int y) const {
    return block >= 0 && block < blocks_ && shows_[index(block, y)] != 0;
  }

  bool shows_about(int block, int y) const {
    return shows(block - 1, y) || shows(block, y) || shows(block + 1, y);
  }

 private:
  std::size_t index(int block, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(blocks_) +
           static_cast<std::size_t>(block);
  }

  int blocks_;
  std::vector<std::uint8_t> shows_;
};

/// A row and its neighbours in steps of a stride; what lies outside the picture is as its border.
class Neighbourhood {
 public:
  Neighbourhood(const Image& image, int stride, int y)
      : image_(image),
        stride_(stride),
        pad_(kReach * stride),
        up_{row(y - stride), row(y - 2 * stride)},
        middle_(row(y)),
        down_{row(y + stride), row(y + 2 * stride)},
        length_(static_cast<std::size_t>(image.width + 2 * pad_ + kLanes)),
        values_(3 * length_) {}

  /// Makes pixels from x to end known.
  void fill(int x, int end) {
    const int from = std::max(x - pad_, 0);
    const int to = std::min(end + pad_, image_.width);
    float* center = values_.data() + pad_;
    float* near = center + length_;
    float* far = near + length_;
    for (int i = from; i < to; ++i) {
      center[i] = middle_[i];
      near[i] = up_[0][i] + down_[0][i];
      far[i] = up_[1][i] + down_[1][i];
    }
    for (float* row : {center, near, far}) {
      for (int i = x - pad_; i < 0; ++i) row[i] = row[0];
      for (int i = image_.width; i < end + pad_; ++i) row[i] = row[image_.width - 1];
    }
  }

  Lanes center(int x) const { return load(values_.data() + pad_ + x); }

  /// Of each class, the sum of the differences to the pixel.
  std::array<Lanes, kClasses> differences(int x) const {
    const float* center = values_.data() + pad_ + x;
    const float* near = center + length_;
    const float* far = near + length_;
    const int one = stride_;
    const int two = 2 * stride_;
    const Lanes four = 4.0F * load(center);
    return {
        load(center - one) + load(center + one) + load(near) - four,
        load(near - one) + load(near + one) - four,
        load(center - two) + load(center + two) + load(far) - four,
        (load(near - two) + load(near + two)) + (load(far - one) + load(far + one)) - 2.0F * four,
        load(far - two) + load(far + two) - four};
  }

  /// Squared differences to the pixels `steps` aside and below, together.
  Lanes squared(int x, int steps) const {
    const Lanes here = center(x);
    const Lanes aside = load(values_.data() + pad_ + x + steps * stride_) - here;
    const float* far = down_[static_cast<std::size_t>(steps - 1)];
    Lanes below{};
    for (int i = 0; i < kLanes; ++i) below[i] = far[std::min(x + i, image_.width - 1)];
    below -= here;
    return aside * aside + below * below;
  }

 private:
  const float* row(int y) const { return row_of(image_, std::clamp(y, 0, image_.height - 1)); }

  const Image& image_;
  int stride_;
  int pad_;
  std::array<const float*, 2> up_;
  const float* middle_;
  std::array<const float*, 2> down_;
  std::size_t length_;
  std::vector<float> values_;  ///< the row, the sums of those one and two steps off
};

/// Sums over pixels that show a shell.
struct Statistics {
  std::array<std::array<double, kClasses>, kClasses> products{};  ///< of the classes' differences
  std::array<double, 2> squares{};  ///< of differences one and two steps aside and below
  double squared_widths = 0.0;      ///< of their layers
  double pixels = 0.0;

  void add(const Statistics& other) {
    for (std::size_t i = 0; i < kClasses; ++i) {
      for (std::size_t j = 0; j < kClasses; ++j) products[i][j] += other.products[i][j];
    }
    for (std::size_t i = 0; i < squares.size(); ++i) squares[i] += other.squares[i];
    squared_widths += other.squared_widths;
    pixels += other.pixels;
  }
};

Statistics statistics_of_row(const Image& image, const Occupancy& occupancy,
                             const LayerLookup& layers, int stride, int y) {
  Neighbourhood around(image, stride, y);
  std::array<std::array<Lanes, kClasses>, kClasses> products{};
  std::array<Lanes, 2> squares{};
  Lanes pixels{};
  Statistics sums;
  for (int block = 0; block < occupancy.blocks(); ++block) {
    if (!occupancy.shows(block, y)) continue;
    const int end = std::min((block + 1) * kBlock, image.width);
    around.fill(block * kBlock, end);
    for (int x = block * kBlock; x < end; x += kLanes) {
      Lanes counted = shows(around.center(x));
      for (int i = end - x; i < kLanes; ++i) counted[i] = 0.0F;
      const std::array<Lanes, kClasses> differences = around.differences(x);
      for (std::size_t i = 0; i < kClasses; ++i) {
        const Lanes difference = counted * differences[i];
        for (std::size_t j = 0; j <= i; ++j) products[i][j] += difference * differences[j];
      }
      squares[0] += counted * around.squared(x, 1);
      squares[1] += counted * around.squared(x, 2);
      pixels += counted;
      for (int i = 0; i < kLanes; ++i) {
        if (counted[i] == 0.0F) continue;
        const LayerRange* layer = layers.find(around.center(x)[i]);
        const double width = layer == nullptr ? 0.0 : double{layer->hi} - double{layer->lo};
        sums.squared_widths += width * width;
      }
    }
  }
  for (std::size_t i = 0; i < kClasses; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      sums.products[i][j] = sum_of(products[i][j]);
      sums.products[j][i] = sums.products[i][j];
    }
  }
  for (std::size_t i = 0; i < squares.size(); ++i) sums.squares[i] = sum_of(squares[i]);
  sums.pixels = sum_of(pixels);
  return sums;
}

Statistics statistics_of(const Image& image, const Occupancy& occupancy, const LayerLookup& layers,
                         int stride, const RowLoop& rows) {
  const int step = std::max(image.height / kSampledRows, 1);
  const int sampled = (image.height + step - 1) / step;
  std::vector<Statistics> of_rows(static_cast<std::size_t>(sampled));
  run(rows, sampled, [&](int i) {
    of_rows[static_cast<std::size_t>(i)] =
        statistics_of_row(image, occupancy, layers, stride, i * step);
  });
  Statistics all;
  for (const Statistics& row : of_rows) all.add(row);
  return all;
}

/// Mean squared difference of pixels one or two steps apart (0, 1), in squared widths.
double mean_square(const Statistics& sums, std::size_t steps) {
  return sums.squared_widths > 0.0 ? 0.5 * sums.squares[steps] / sums.squared_widths : 0.0;
}

/// -E[(q(n) - q(p)) u(p)], u what quantising leaves, in squared widths, for neighbours `distance`
/// steps away (docs/derivations.md, 3.5).
double covariance_with_error(const Statistics& sums, double distance) {
  constexpr double kVariance = 1.0 / 12.0;
  const double near = mean_square(sums, 0);
  const double far = mean_square(sums, 1);
  if (!(near > 0.0)) return 0.0;
  const double power = std::clamp(std::log2(far / near), 0.0, 2.0);
  const double square = near * std::pow(distance, power);
  return square < 0.5 ? std::min(kVariance, 0.5 * square * (1.0 - square)) : kVariance;
}

/// Solves for the weights by Cholesky's factors; all 0 where the differences say nothing.
std::array<double, kClasses> solve(std::array<std::array<double, kClasses>, kClasses> a,
                                   std::array<double, kClasses> b) {
  double trace = 0.0;
  for (std::size_t i = 0; i < kClasses; ++i) trace += a[i][i];
  if (!(trace > 0.0)) return {};
  for (std::size_t i = 0; i < kClasses; ++i) a[i][i] += 1e-6 * trace;
  for (std::size_t i = 0; i < kClasses; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = a[i][j];
      for (std::size_t k = 0; k < j; ++k) rest -= a[i][k] * a[j][k];
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

std::array<double, kClasses> weights_of(const Statistics& sums) {
  constexpr std::array<double, kClasses> kNeighbours{4, 4, 4, 8, 4};
  const std::array<double, kClasses> distances{1.0, std::sqrt(2.0), 2.0, std::sqrt(5.0),
                                               std::sqrt(8.0)};
  std::array<double, kClasses> right{};
  for (std::size_t i = 0; i < kClasses; ++i) {
    right[i] = kNeighbours[i] * sums.squared_widths * covariance_with_error(sums, distances[i]);
  }
  return solve(sums.products, right);
}

LayerFilter filter_of(const Image& image, const Occupancy& occupancy, const LayerLookup& layers,
                      const RowLoop& rows) {
  for (int stride = 1;; stride *= 2) {
    const Statistics sums = statistics_of(image, occupancy, layers, stride, rows);
    if (stride == kMaxStride || mean_square(sums, 0) >= kIndependent) {
      return {stride, weights_of(sums)};
    }
  }
}

/// What a row is estimated to be.
class RowEstimate {
 public:
  RowEstimate(const LayerFilter& filter, const LayerLookup& layers)
      : stride_(filter.stride), layers_(layers) {
    for (std::size_t i = 0; i < kClasses; ++i) {
      weights_[i] = static_cast<float>(filter.weights[i]);
    }
  }

  void write(const Image& image, const Occupancy& occupancy, const std::uint8_t* fixed, int y,
             float* out) const {
    Neighbourhood around(image, stride_, y);
    for (int block = 0; block < occupancy.blocks(); ++block) {
      const int x = block * kBlock;
      const int end = std::min(x + kBlock, image.width);
      if (shows_near(image, occupancy, block, y)) {
        around.fill(x, end);
        write_block(around, fixed, x, end, out);
      }
    }
  }

 private:
  bool shows_near(const Image& image, const Occupancy& occupancy, int block, int y) const {
    for (int step = -kReach; step <= kReach; ++step) {
      const int row = std::clamp(y + step * stride_, 0, image.height - 1);
      if (occupancy.shows_about(block, row)) return true;
    }
    return false;
  }

  void write_block(const Neighbourhood& around, const std::uint8_t* fixed, int x, int end,
                   float* out) const {
    for (; x < end; x += kLanes) {
      const std::array<Lanes, kClasses> differences = around.differences(x);
      Lanes change{};
      for (std::size_t i = 0; i < kClasses; ++i) change += weights_[i] * differences[i];
      const Lanes here = around.center(x);
      for (int i = 0; i < std::min(kLanes, end - x); ++i) {
        if (change[i] == 0.0F) continue;
        if (fixed != nullptr && here[i] == 0.0F && fixed[x + i] != 0) continue;
        const LayerRange* layer = layers_.find(here[i]);
        if (layer != nullptr) out[x + i] = std::clamp(here[i] + change[i], layer->lo, layer->hi);
      }
    }
  }

  int stride_;
  std::array<float, kClasses> weights_{};
  const LayerLookup& layers_;
};

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

LayerFilter layer_filter(const Image& maximum, std::span<const LayerRange> layers,
                         const RowLoop& rows) {
  return filter_of(maximum, Occupancy(maximum, rows), LayerLookup(layers), rows);
}

void dequantize(Image& maximum, std::span<const LayerRange> layers,
                std::span<const std::uint8_t> fixed, const RowLoop& rows,
                std::vector<float>& memory) {
  const Occupancy occupancy(maximum, rows);
  const LayerLookup lookup(layers);
  const RowEstimate estimate(filter_of(maximum, occupancy, lookup, rows), lookup);
  memory.resize(maximum.pixels.size());
  run(rows, maximum.height, [&](int y) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(maximum.width) * y;
    float* out = memory.data() + first;
    std::copy_n(maximum.pixels.data() + first, maximum.width, out);
    estimate.write(maximum, occupancy, fixed.empty() ? nullptr : fixed.data() + first, y, out);
  });
  maximum.pixels.swap(memory);
}

void dequantize(Image& maximum, std::span<const LayerRange> layers,
                std::span<const std::uint8_t> fixed, const RowLoop& rows) {
  std::vector<float> memory;
  dequantize(maximum, layers, fixed, rows, memory);
}

}  // namespace nacre

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
/// Variance of errors that contours and simplifying leave in each class's sum of differences, in
/// squared widths. Without it, weights would grow beyond measure along straight vessels.
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
        values_(5 * length_) {}

  /// Makes the sums of differences of pixels from x to end known.
  void fill(int x, int end) {
    float* center = padded(0);
    float* near = padded(1);
    float* far = padded(2);
    const int to = std::min(end + pad_, image_.width);
    for (int i = std::max(x - pad_, 0); i < to; ++i) {
      center[i] = middle_[i];
      near[i] = up_[0][i] + down_[0][i];
      far[i] = up_[1][i] + down_[1][i];
    }
    for (float* row : {center, near, far}) fill_borders(row, x, end);
  }

  /// Makes single differences to the rows below known, after `fill`.
  void fill_below(int x, int end) {
    const int from = std::max(x - pad_, 0);
    const int to = std::min(end + pad_, image_.width);
    for (std::size_t step = 0; step < down_.size(); ++step) {
      float* below = padded(3 + step);
      std::copy(down_[step] + from, down_[step] + to, below + from);
      fill_borders(below, x, end);
    }
  }

  Lanes center(int x) const { return load(padded(0) + x); }

  /// Of each class, the sum of the differences to the pixel.
  std::array<Lanes, kClasses> differences(int x) const {
    const float* center = padded(0) + x;
    const float* near = padded(1) + x;
    const float* far = padded(2) + x;
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

  /// The squared difference to one neighbour, beside or below.
  Lanes squared(int x, const Offset& offset) const {
    const std::size_t row = offset.y == 0 ? 0 : 2 + static_cast<std::size_t>(offset.y);
    const Lanes difference = load(padded(row) + x + offset.x * stride_) - center(x);
    return difference * difference;
  }

 private:
  const float* row(int y) const { return row_of(image_, std::clamp(y, 0, image_.height - 1)); }

  float* padded(std::size_t row) { return values_.data() + row * length_ + pad_; }
  const float* padded(std::size_t row) const { return values_.data() + row * length_ + pad_; }

  void fill_borders(float* row, int x, int end) const {
    for (int i = x - pad_; i < 0; ++i) row[i] = row[0];
    for (int i = image_.width; i < end + pad_; ++i) row[i] = row[image_.width - 1];
  }

  const Image& image_;
  int stride_;
  int pad_;
  std::array<const float*, kReach> up_;
  const float* middle_;
  std::array<const float*, kReach> down_;
  std::size_t length_;
  /// The row, the sums of those one and two steps off, those one and two steps below.
  std::vector<float> values_;
};

/// Sums over pixels that show a shell.
struct Statistics {
  std::array<std::array<double, kClasses>, kClasses> products{};  ///< of the classes' differences
  std::array<double, kOffsets.size()> squares{};                  ///< of single differences
  double squared_widths = 0.0;                                    ///< of their layers

  void add(const Statistics& other) {
    for (std::size_t i = 0; i < kClasses; ++i) {
      for (std::size_t j = 0; j < kClasses; ++j) products[i][j] += other.products[i][j];
    }
    for (std::size_t i = 0; i < squares.size(); ++i) squares[i] += other.squares[i];
    squared_widths += other.squared_widths;
  }
};

/// The squared widths of the layers of the lanes that count, added up.
double squared_widths(const Lanes& shown, const Lanes& counted, const LayerLookup& layers) {
  double sum = 0.0;
  for (int i = 0; i < kLanes; ++i) {
    const LayerRange* layer = counted[i] > 0.0F ? layers.find(shown[i]) : nullptr;
    if (layer == nullptr) continue;
    const double width = double{layer->hi} - double{layer->lo};
    sum += width * width;
  }
  return sum;
}

Statistics statistics_of_row(const Image& image, const Occupancy& occupancy,
                             const LayerLookup& layers, int stride, int y) {
  Neighbourhood around(image, stride, y);
  std::array<std::array<Lanes, kClasses>, kClasses> products{};
  std::array<Lanes, kOffsets.size()> squares{};
  Statistics sums;
  for (int block = 0; block < occupancy.blocks(); ++block) {
    if (!occupancy.shows(block, y)) continue;
    const int end = std::min((block + 1) * kBlock, image.width);
    around.fill(block * kBlock, end);
    around.fill_below(block * kBlock, end);
    for (int x = block * kBlock; x < end; x += kLanes) {
      Lanes counted = shows(around.center(x));
      for (int i = end - x; i < kLanes; ++i) counted[i] = 0.0F;
      const std::array<Lanes, kClasses> differences = around.differences(x);
      for (std::size_t i = 0; i < kClasses; ++i) {
        const Lanes difference = counted * differences[i];
        for (std::size_t j = 0; j <= i; ++j) products[i][j] += difference * differences[j];
      }
      for (std::size_t i = 0; i < kOffsets.size(); ++i) {
        squares[i] += counted * around.squared(x, kOffsets[i]);
      }
      sums.squared_widths += squared_widths(around.center(x), counted, layers);
    }
  }
  for (std::size_t i = 0; i < kClasses; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      sums.products[i][j] = sums.products[j][i] = sum_of(products[i][j]);
    }
  }
  for (std::size_t i = 0; i < squares.size(); ++i) sums.squares[i] = sum_of(squares[i]);
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

/// -E[(q(n) - q(p)) u(p)], u what quantising leaves, in squared widths, where the neighbour's mean
/// squared difference is that (docs/derivations.md, 3.5).
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
  if (!(sums.squared_widths > 0.0)) return {};
  std::array<std::array<double, kClasses>, kClasses> left = sums.products;
  std::array<double, kClasses> right{};
  for (std::size_t i = 0; i < kClasses; ++i) left[i][i] += kOtherErrors * sums.squared_widths;
  for (std::size_t i = 0; i < kOffsets.size(); ++i) {  // each stands for the opposite one as well
    right[kOffsets[i].index] +=
        2.0 * sums.squared_widths * covariance_with_error(sums.squares[i] / sums.squared_widths);
  }
  return solve(left, right);
}

/// Of the next pixels beside and below, in squared widths.
double mean_square(const Statistics& sums) {
  return sums.squared_widths > 0.0 ? 0.5 * (sums.squares[0] + sums.squares[1]) / sums.squared_widths
                                   : kIndependent;
}

LayerFilter filter_of(const Image& image, const Occupancy& occupancy, const LayerLookup& layers,
                      const RowLoop& rows) {
  for (int stride = 1;; stride *= 2) {
    const Statistics sums = statistics_of(image, occupancy, layers, stride, rows);
    if (stride == kMaxStride || mean_square(sums) >= kIndependent) {
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

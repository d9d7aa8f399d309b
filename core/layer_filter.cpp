#include "core/layer_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nacre::layers {
namespace {

/// Mean squared difference of neighbours, in squared layers, up to which steps are made wider: what
/// quantising leaves of samples in the same layer is the same.
constexpr double kAlike = 0.3;
/// Variance of errors that contours and simplifying leave in each class's sum of differences, in
/// squared layers. Without it, weights would grow beyond measure along straight vessels.
constexpr double kOtherErrors = 0.2;
/// Rows that covariances are taken from, at even distances.
constexpr int kSampledRows = 128;

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

}  // namespace

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

template LayerFilter filter_of(const LayerSamples<std::uint8_t>&, const Occupancy<std::uint8_t>&,
                               const RowLoop&);
template LayerFilter filter_of(const LayerSamples<std::uint16_t>&, const Occupancy<std::uint16_t>&,
                               const RowLoop&);

}  // namespace nacre::layers

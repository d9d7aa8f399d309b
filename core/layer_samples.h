#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "core/dequantization.h"

// How `dequantize` looks at a pixel's neighbours. Nothing else needs this header.

namespace nacre::layers {

inline constexpr std::size_t kClasses = 5;
inline constexpr int kReach = 2;  ///< steps
/// Steps are at most so many pixels wide.
inline constexpr int kMaxStride = 16;
/// Pixels are looked at in blocks, those far from any shell not at all.
inline constexpr int kBlock = kReach * kMaxStride;

/// Sums of numbers of layers.
template <class Rank>
using SumOf = std::conditional_t<sizeof(Rank) == 1, std::int16_t, std::int32_t>;

template <class Rank>
const Rank* sample_row(const LayerSamples<Rank>& samples, int y) {
  const int rows = samples.height * samples.per_pixel;
  const auto width = static_cast<std::ptrdiff_t>(samples.width) * samples.per_pixel;
  return samples.ranks.data() + width * std::clamp(y, 0, rows - 1);
}

/// Which blocks of each row of samples show a shell.
template <class Rank>
class Occupancy {
 public:
  Occupancy(const LayerSamples<Rank>& samples, const RowLoop& rows)
      : blocks_((samples.width + kBlock - 1) / kBlock),
        shows_(static_cast<std::size_t>(blocks_) *
               static_cast<std::size_t>(samples.height * samples.per_pixel)) {
    const int block = kBlock * samples.per_pixel;
    const int width = samples.width * samples.per_pixel;
    rows(samples.height, [&](int pixel_row) {
      for (int i = 0; i < samples.per_pixel; ++i) {
        const int y = pixel_row * samples.per_pixel + i;
        const Rank* row = sample_row(samples, y);
        for (int b = 0; b < blocks_; ++b) {
          shows_[index(b, y)] = any(row + b * block, row + std::min((b + 1) * block, width));
        }
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
  static bool any(const Rank* from, const Rank* to) {
    std::uint64_t word = 0;
    std::uint64_t bits = 0;
    constexpr int kTogether = sizeof word / sizeof(Rank);
    for (; to - from >= kTogether; from += kTogether) {
      std::memcpy(&word, from, sizeof word);
      bits |= word;
    }
    for (; from != to; ++from) bits |= *from;
    return bits != 0;
  }

  std::size_t index(int block, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(blocks_) +
           static_cast<std::size_t>(block);
  }

  int blocks_;
  std::vector<std::uint8_t> shows_;
};

/// A row of pixels, each the sample in its middle, and the samples around it in steps of a stride;
/// what lies outside the picture is as its border.
template <class Rank>
class Neighbourhood {
 public:
  using Sum = SumOf<Rank>;

  /// @param stride  samples, at most kMaxStride pixels
  /// @param below   whether the rows below are wanted by themselves, for `neighbour`
  Neighbourhood(const LayerSamples<Rank>& samples, int stride, int y, bool below = false)
      : per_pixel_(samples.per_pixel),
        stride_(stride),
        width_(samples.width * per_pixel_),
        pad_(kBlock * per_pixel_),
        length_(static_cast<std::size_t>(samples.width + 2 * kBlock)),
        rows_(below ? 5U : 3U),
        together_(static_cast<std::size_t>(width_ + 2 * pad_)),
        values_(rows_ * static_cast<std::size_t>(per_pixel_) * length_) {
    const int middle = y * per_pixel_ + per_pixel_ / 2;
    for (int step = -kReach; step <= kReach; ++step) {
      around_[static_cast<std::size_t>(step + kReach)] =
          sample_row(samples, middle + step * stride);
    }
  }

  /// Makes what lies about the pixels from x to end known.
  void fill(int x, int end) {
    const std::array<const Rank*, 5>& r = around_;
    fill_row(0, x, end, [&](int i) { return static_cast<Sum>(r[2][i]); });
    fill_row(1, x, end, [&](int i) { return static_cast<Sum>(r[1][i] + r[3][i]); });
    fill_row(2, x, end, [&](int i) { return static_cast<Sum>(r[0][i] + r[4][i]); });
    if (rows_ < 5) return;
    fill_row(3, x, end, [&](int i) { return static_cast<Sum>(r[3][i]); });
    fill_row(4, x, end, [&](int i) { return static_cast<Sum>(r[4][i]); });
  }

  /// The pixels' own ranks, of pixel 0 and on.
  const Sum* center() const { return at(0, 0); }

  /// Of each class, the sums of the differences to `count` pixels from x on.
  void differences(int x, int count, std::array<std::array<Sum, kBlock>, kClasses>& out) const {
    const Sum* c0 = at(0, 0) + x;
    const Sum* cl1 = at(0, -1) + x;
    const Sum* cr1 = at(0, 1) + x;
    const Sum* cl2 = at(0, -2) + x;
    const Sum* cr2 = at(0, 2) + x;
    const Sum* n0 = at(1, 0) + x;
    const Sum* nl1 = at(1, -1) + x;
    const Sum* nr1 = at(1, 1) + x;
    const Sum* nl2 = at(1, -2) + x;
    const Sum* nr2 = at(1, 2) + x;
    const Sum* f0 = at(2, 0) + x;
    const Sum* fl1 = at(2, -1) + x;
    const Sum* fr1 = at(2, 1) + x;
    const Sum* fl2 = at(2, -2) + x;
    const Sum* fr2 = at(2, 2) + x;
    for (int i = 0; i < count; ++i) {
      const auto four = static_cast<Sum>(4 * c0[i]);
      const auto k = static_cast<std::size_t>(i);
      out[0][k] = static_cast<Sum>(cl1[i] + cr1[i] + n0[i] - four);
      out[1][k] = static_cast<Sum>(nl1[i] + nr1[i] - four);
      out[2][k] = static_cast<Sum>(cl2[i] + cr2[i] + f0[i] - four);
      out[3][k] = static_cast<Sum>(nl2[i] + nr2[i] + fl1[i] + fr1[i] - 2 * four);
      out[4][k] = static_cast<Sum>(fl2[i] + fr2[i] - four);
    }
  }

  /// The neighbour so many steps aside and below (0 to 2) of pixel 0 and on.
  /// @pre made with `below`
  const Sum* neighbour(int aside, int below) const {
    return at(below == 0 ? 0 : 2 + static_cast<std::size_t>(below), aside);
  }

 private:
  /// A row, or a sum of rows, `step` steps aside of each pixel.
  const Sum* at(std::size_t row, int step) const {
    const int offset = pad_ + per_pixel_ / 2 + step * stride_;
    const auto phase = static_cast<std::size_t>(offset % per_pixel_);
    return values_.data() + (row * static_cast<std::size_t>(per_pixel_) + phase) * length_ +
           offset / per_pixel_;
  }

  /// Takes a row of samples apart, so that those of neighbouring pixels lie side by side.
  template <class Sample>
  void fill_row(std::size_t row, int x, int end, const Sample& sample) {
    const int reach = kReach * stride_;
    const int first = x * per_pixel_ - reach;
    const int last = end * per_pixel_ + reach;  // one beyond
    Sum* const values = together_.data() + pad_;
    for (int i = std::max(first, 0); i < std::min(last, width_); ++i) values[i] = sample(i);
    for (int i = first; i < 0; ++i) values[i] = sample(0);
    for (int i = width_; i < last; ++i) values[i] = sample(width_ - 1);
    Sum* out = values_.data() + row * static_cast<std::size_t>(per_pixel_) * length_;
    const int from = (first + pad_) / per_pixel_;
    const int to = (last + pad_ + per_pixel_ - 1) / per_pixel_;
    if (per_pixel_ == 1) {
      std::copy(together_.data() + from, together_.data() + to, out + from);
    } else if (per_pixel_ == 3) {
      take_apart<3>(from, to, out);
    } else {
      take_apart<0>(from, to, out);
    }
  }

  /// @tparam Known  `per_pixel_`, or 0
  template <int Known>
  void take_apart(int from, int to, Sum* out) const {
    const int phases = Known > 0 ? Known : per_pixel_;
    for (int phase = 0; phase < phases; ++phase) {
      const Sum* in = together_.data() + phase;
      Sum* const to_phase = out + static_cast<std::size_t>(phase) * length_;
      for (int k = from; k < to; ++k) to_phase[k] = in[k * phases];
    }
  }

  int per_pixel_;
  int stride_;
  int width_;  ///< samples
  int pad_;    ///< samples at either side
  std::size_t length_;
  std::size_t rows_;
  std::array<const Rank*, 5> around_{};
  std::vector<Sum> together_;  ///< a row as it lies in the picture
  /// The row, the sums of those one and two steps off, those one and two steps below; of each the
  /// first, second, ... samples of all pixels.
  std::vector<Sum> values_;
};

}  // namespace nacre::layers

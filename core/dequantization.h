#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/image.h"

namespace nacre {

/// What the pixels of one layer of a maximum projection show, and may really be.
struct LayerRange {
  float lo = 0.0F;     ///< its level, t_k; 0 for the background
  float shown = 0.0F;  ///< the representative, r_k
  float hi = 0.0F;     ///< the next level, or 1
};

/// A shell's level t_k and its representative r_k.
struct LayerLevel {
  double emission = 0.0;
  double representative = 0.0;
};

/// The layers between levels that are all shown, the background first; those that are shown alike
/// are one. Empty where a layer does not contain its representative, which then is no estimate of
/// it.
///
/// @param levels  ascending
/// @param factor  of all emissions: that of a cue which is the same at all depths
std::vector<LayerRange> layer_ranges(std::span<const LayerLevel> levels, double factor = 1.0);

/// Runs a function for 0, 1, ... count - 1, in any order, possibly at once.
using RowLoop = std::function<void(int count, const std::function<void(int)>& row)>;

/// The layers that rays through a picture show, by number, the background's being 0: an odd number
/// of rays a pixel along each axis, evenly spaced, that in the middle through the pixel's centre.
template <class Rank>
struct LayerSamples {
  int width = 0;  ///< of the picture, pixels
  int height = 0;
  int per_pixel = 1;            ///< along each axis; odd
  std::span<const Rank> ranks;  ///< width * per_pixel a row
};

/// The weights of the samples around a pixel's centre, in steps of `stride` samples aside and up:
/// those 1, 1.4, 2, 2.2 and 2.8 steps away (4, 4, 4, 8 and 4 of them).
struct LayerFilter {
  int stride = 1;
  std::array<double, 5> weights{};
};

/// The filter that `dequantize` takes for a picture.
template <class Rank>
LayerFilter layer_filter(const LayerSamples<Rank>& samples, const RowLoop& rows = {});

/// Estimates a maximum projection between the levels from the layers that rays show, by the linear
/// filter of least mean squared error (a Wiener filter; docs/derivations.md, 3.5):
///
///     v(p) = k(p) + sum_l w_l sum_(n in l) (k(n) - k(p)),
///
/// where k(p) is the layer's number at the pixel's centre, l are the classes of neighbouring
/// samples in `LayerFilter`. The weights are those for which the estimated error is least, from the
/// picture's own covariances and the variance of what quantising to layers leaves, 1 / 12. The
/// emission is linear in v from the layer's level (k - 1/2) to its representative (k), and from
/// there to the next level. No pixel leaves its layer, so that no error becomes larger than a layer
/// is wide.
///
/// The same picture gives the same bytes for any way of running the rows.
///
/// @param layers   ascending, one for each rank
/// @param fixed    pixels of the background that stay black, if not 0; empty: none. For tools,
///                 which end rays: the next pixel's vessel may lie behind them
/// @param maximum  the result; its memory is used anew where it suffices
template <class Rank>
void dequantize(const LayerSamples<Rank>& samples, std::span<const LayerRange> layers,
                std::span<const std::uint8_t> fixed, const RowLoop& rows, Image& maximum);

/// What `dequantize` keeps from picture to picture: new memory for each costs more than the filter.
struct DequantizationMemory {
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint16_t> words;
};

/// The same for a picture of representatives. Pixels that show none of them stay as they are; for
/// their neighbours they are of the layer that they lie in.
///
/// @param samples  an uncued maximum projection, as large as the picture times `per_pixel`
/// @param layers   at most 65536
void dequantize(const Image& samples, int per_pixel, std::span<const LayerRange> layers,
                std::span<const std::uint8_t> fixed, const RowLoop& rows,
                DequantizationMemory& memory, Image& maximum);

/// The same in place, of one ray a pixel, where memory does not matter.
void dequantize(Image& maximum, std::span<const LayerRange> layers,
                std::span<const std::uint8_t> fixed = {}, const RowLoop& rows = {});

/// The middle samples alone: the picture of one ray a pixel.
Image middle_samples(const Image& samples, int per_pixel);

}  // namespace nacre

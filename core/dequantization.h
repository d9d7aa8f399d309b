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

/// The weights of a pixel's neighbours, in steps of `stride` pixels aside and up: those 1, 1.4, 2,
/// 2.2 and 2.8 steps away (4, 4, 4, 8 and 4 of them).
struct LayerFilter {
  int stride = 1;
  std::array<double, 5> weights{};
};

/// The filter that `dequantize` takes for a picture.
LayerFilter layer_filter(const Image& maximum, std::span<const LayerRange> layers,
                         const RowLoop& rows = {});

/// Estimates the maximum projection between the levels from the layers that a picture of shells
/// shows, by the linear filter of least mean squared error (a Wiener filter; docs/derivations.md,
/// 3.5):
///
///     v(p) = q(p) + sum_l w_l sum_(n in l) (q(n) - q(p)),
///
/// where q is the picture, l are the classes of neighbours in `LayerFilter`. The weights are those
/// for which the estimated error is least, from the picture's own covariances and the variance of
/// what quantising to layers leaves, width^2 / 12. No pixel leaves its layer, so that no error
/// becomes larger than a layer is wide.
///
/// The same picture gives the same bytes for any way of running the rows.
///
/// @param maximum  an uncued maximum projection: every pixel is a layer's representative (others
///                 stay as they are)
/// @param layers   ascending
/// @param fixed    pixels of the background that stay black, if not 0; empty: none. For tools,
/// which
///                 end rays: the next pixel's vessel may lie behind them
/// @param memory  where the result is put; has the memory of what the picture was when this returns
void dequantize(Image& maximum, std::span<const LayerRange> layers,
                std::span<const std::uint8_t> fixed, const RowLoop& rows,
                std::vector<float>& memory);

/// The same where memory does not matter.
void dequantize(Image& maximum, std::span<const LayerRange> layers,
                std::span<const std::uint8_t> fixed = {}, const RowLoop& rows = {});

}  // namespace nacre

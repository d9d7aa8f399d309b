#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/walk_field.h"

namespace nacre {

/// A contoured level, and the emission shown for the layer from it up to the next one.
struct ShownLevel {
  double value = 0.0;           ///< contour value v_k, in the volume's values
  double representative = 0.0;  ///< r_k, in [0, 1]
};

/// Levels made ready for walks: a point's layer is the number n of levels with v_k <= value.
struct LayerLadder {
  /// @throws Error  BadArgument for no levels, values that are not finite and ascending, or
  ///                representatives outside [0, 1]
  LayerLadder(const WalkField& field, std::span<const ShownLevel> levels);

  /// How many levels a value reaches, among those from `lo` to `hi`.
  std::size_t reached(double value, std::size_t lo, std::size_t hi) const;
  std::size_t reached(double value) const { return reached(value, 0, values.size()); }

  std::vector<double> values;     ///< v_1, v_2, ... in field units
  std::vector<double> shown;      ///< by layer: r_n, 0 for the background
  std::vector<double> brightest;  ///< by layer: the largest r_k, k <= n, of the shells around it
  std::vector<std::uint32_t> least_layer;  ///< in each brick
  std::vector<std::uint32_t> greatest_layer;
};

}  // namespace nacre

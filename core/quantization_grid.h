#pragma once

#include <glm/vec3.hpp>

#include "core/shell_set.h"

namespace nacre {

/// Fewest and most bits of a grid. Floats hold 24; Draco's rounding, floor(x + 1/2) in float, needs
/// one for itself.
inline constexpr int kMinGridBits = 1;
inline constexpr int kMaxGridBits = 23;

/// Distance of neighbouring lattice points in mm: range / (2^bits - 1).
double step_mm(const QuantizationGrid& grid) noexcept;

/// Whether every lattice point is a float that the arithmetic of a Draco decoder,
/// float(i) * (range / (2^bits - 1)) + origin, reaches without a single rounding.
///
/// Then positions are the same bits on every machine, with fused multiply-adds or without, and
/// encoding what was decoded changes nothing. It holds when the step is m * 2^e with an odd m,
/// m * 2^bits <= 2^24, the origin is a multiple of 2^e, and no coordinate exceeds 2^24 * 2^e; with
/// more than 20 bits, when also m = 1 (the encoder multiplies by a rounded 1 / step).
bool is_exact(const QuantizationGrid& grid) noexcept;

/// The power of two of which the step is an odd multiple: every lattice point is an integer
/// multiple of it, of at most 2^24.
/// @pre  is_exact(grid)
double unit_mm(const QuantizationGrid& grid) noexcept;

/// The lattice point of an index: origin + step * index.
/// @pre  is_exact(grid), 0 <= index < 2^bits
glm::vec3 grid_position(const QuantizationGrid& grid, const glm::ivec3& index) noexcept;

/// The index of the lattice point nearest to a position, clamped to the grid.
glm::ivec3 nearest_index(const QuantizationGrid& grid, const glm::dvec3& position_mm) noexcept;

/// Whether a position is a lattice point, bit for bit (a zero of either sign is zero).
bool is_on(const QuantizationGrid& grid, const glm::vec3& position_mm) noexcept;

}  // namespace nacre

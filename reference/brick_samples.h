#pragma once

#include <algorithm>
#include <cstring>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "reference/bright_bricks.h"
#include "reference/cell_kernel.h"
#include "reference/walk_field.h"

namespace nacre {

/// The bits (x + 4 y + 16 z) of the cells that a brick has within the volume.
inline unsigned long long cells_within(const glm::ivec3& cells) {
  constexpr int kSide = BrightBricks::kSide;
  static_assert(kSide == 4 && kSide == BrickSamples::kCells);
  const auto first = [](int count, int step) {
    unsigned long long bits = 0;
    for (int i = 0; i < count && i < BrightBricks::kSide; ++i) bits |= 1ULL << (i * step);
    return bits;
  };
  // Products of disjoint sums: each pair of bits at a place of its own.
  return first(cells.x, 1) * first(cells.y, kSide) * first(cells.z, kSide * kSide);
}

/// A row of five samples, in field units.
template <class T>
inline void load_row(const T* row, double factor, double* out) {
  constexpr int kFour = 4;
  static_assert(BrickSamples::kSamples == kFour + 1);
  using Samples [[gnu::vector_size(kFour * sizeof(T))]] = T;
  using Doubles [[gnu::vector_size(kFour * sizeof(double))]] = double;
  Samples samples;
  std::memcpy(&samples, row, sizeof(samples));
  const Doubles values = factor * __builtin_convertvector(samples, Doubles);
  std::memcpy(out, &values, sizeof(values));
  out[kFour] = factor * static_cast<double>(row[kFour]);
}

/// Asks for a brick's samples ahead of `load_samples`.
inline void prefetch_samples(const WalkField& field, const glm::ivec3& first_cell) {
  constexpr int kSamples = BrickSamples::kSamples;
  const glm::i64vec3& dims = field.volume->dims;
  if (first_cell.y + kSamples > dims.y || first_cell.z + kSamples > dims.z) return;
  visit_samples(*field.volume, [&]<class T>(std::span<const T> samples) {
    const T* first =
        samples.data() + (first_cell.x + dims.x * (first_cell.y + dims.y * first_cell.z));
    for (int z = 0; z < kSamples; ++z) {
      for (int y = 0; y < kSamples; ++y) __builtin_prefetch(first + dims.x * (y + dims.y * z));
    }
  });
}

/// Reads a brick's samples. Beyond the border the last sample is repeated (so a volume of one
/// sample along an axis has a cell there between it and itself).
inline void load_samples(const WalkField& field, const glm::ivec3& first_cell,
                         BrickSamples& brick) {
  constexpr int kSamples = BrickSamples::kSamples;
  for (int axis = 0; axis < 3; ++axis) {
    brick.first_cell[axis] = static_cast<double>(first_cell[axis]);
  }
  const glm::i64vec3& dims = field.volume->dims;
  const bool inside = first_cell.x + kSamples <= dims.x && first_cell.y + kSamples <= dims.y &&
                      first_cell.z + kSamples <= dims.z;
  visit_samples(*field.volume, [&]<class T>(std::span<const T> samples) {
    const double factor = field.factor;
    double* out = brick.sample;
    if (inside) {
      const T* first =
          samples.data() + (first_cell.x + dims.x * (first_cell.y + dims.y * first_cell.z));
      for (int z = 0; z < kSamples; ++z) {
        for (int y = 0; y < kSamples; ++y) {
          load_row(first + dims.x * (y + dims.y * z), factor, out);
          out += kSamples;
        }
      }
      return;
    }
    const auto clamped = [](int at, std::int64_t size) {
      return std::min<std::int64_t>(at, size - 1);
    };
    for (int z = 0; z < kSamples; ++z) {
      for (int y = 0; y < kSamples; ++y) {
        const std::int64_t row = dims.x * (clamped(first_cell.y + y, dims.y) +
                                           dims.y * clamped(first_cell.z + z, dims.z));
        for (int x = 0; x < kSamples; ++x) {
          const std::int64_t at = row + clamped(first_cell.x + x, dims.x);
          *out++ = factor * static_cast<double>(samples[static_cast<std::size_t>(at)]);
        }
      }
    }
  });
}

}  // namespace nacre

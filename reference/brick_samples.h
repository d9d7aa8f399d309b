#pragma once

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "reference/bright_bricks.h"
#include "reference/cell_kernel.h"
#include "reference/walk_field.h"

namespace nacre {

/// A brick's samples, and what each of its cells can reach.
struct LoadedBrick {
  static constexpr int kSide = BrightBricks::kSide;
  static_assert(kSide == BrickSamples::kCells);

  BrickSamples samples;
  glm::ivec3 first_cell{0};
  glm::ivec3 cells{0};                                   ///< fewer at the volume's border
  std::array<double, kSide * kSide * kSide> greatest{};  ///< of each cell's corners, x fastest
};

/// Reads a brick. Beyond the border the last sample is repeated (and a volume of one sample along
/// an axis has a cell there between it and itself).
inline void load_brick(const WalkField& field, const glm::ivec3& first_cell, LoadedBrick& brick) {
  constexpr int kSamples = BrickSamples::kSamples;
  constexpr int kSide = LoadedBrick::kSide;
  brick.first_cell = first_cell;
  brick.cells = glm::min(glm::ivec3(kSide), glm::ivec3(field.cells) - first_cell);
  for (int axis = 0; axis < 3; ++axis) {
    brick.samples.first_cell[axis] = static_cast<double>(first_cell[axis]);
  }
  const glm::i64vec3& dims = field.volume->dims;
  visit_samples(*field.volume, [&]<class T>(std::span<const T> samples) {
    double* out = brick.samples.sample;
    for (int z = 0; z < kSamples; ++z) {
      const std::int64_t at_z = std::min<std::int64_t>(first_cell.z + z, dims.z - 1);
      for (int y = 0; y < kSamples; ++y) {
        const std::int64_t at_y = std::min<std::int64_t>(first_cell.y + y, dims.y - 1);
        const std::int64_t row = dims.x * (at_y + dims.y * at_z);
        for (int x = 0; x < kSamples; ++x) {
          const std::int64_t at_x = std::min<std::int64_t>(first_cell.x + x, dims.x - 1);
          *out++ =
              field.factor * static_cast<double>(samples[static_cast<std::size_t>(row + at_x)]);
        }
      }
    }
  });
  // Along x, y and z in turn.
  constexpr int kY = kSamples;
  constexpr int kZ = kSamples * kSamples;
  std::array<double, kSamples * kZ> along_x;
  const double* sample = brick.samples.sample;
  for (std::size_t i = 0; i + 1 < along_x.size(); ++i) {
    along_x[i] = std::max(sample[i], sample[i + 1]);
  }
  std::array<double, kSamples * kZ> along_y;
  for (std::size_t i = 0; i + kY + 1 < along_y.size(); ++i) {
    along_y[i] = std::max(along_x[i], along_x[i + kY]);
  }
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const auto i = static_cast<std::size_t>(x + kY * y + kZ * z);
        brick.greatest[static_cast<std::size_t>(x + kSide * (y + kSide * z))] =
            std::max(along_y[i], along_y[i + kZ]);
      }
    }
  }
}

}  // namespace nacre

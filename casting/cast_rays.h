#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "casting/sample_kernel.h"
#include "core/camera.h"
#include "reference/pixel_range.h"
#include "reference/tile_rays.h"

namespace nacre {

/// The axes of cells as the rays of a tile take them: planes lie across the one that they are
/// steepest to.
struct CastAxes {
  int u;
  int v;
  int plane;
};

/// The axis that all rays of some pixels are steep to, going the same way along it: each passes at
/// least half as many cells along it as along any other. Nothing where they spread too far.
std::optional<CastAxes> steep_axes(const WalkField& field, const Camera& camera,
                                   const PixelRange& pixels);

/// Those of each tile of a picture, row by row; nothing if the rays of one spread too far.
std::optional<std::vector<CastAxes>> axes_of_tiles(const WalkField& field, const Camera& camera);

/// The rays of a tile of pixels, in arrays for the kernel.
class CastRays {
 public:
  /// No rays.
  void clear(const CastAxes& axes);

  /// @param x, y   within the tile
  /// @param ray    its line and the part of it that is visible
  /// @param start  the least that it shows
  void put(int x, int y, const PixelLine& ray, float start);

  /// Rays that are cut off nowhere and show nothing to begin with.
  /// @param tile  its pixels
  void put_parallel(const ParallelLines& lines, const PixelRange& tile);

  /// The arrays, as put so far.
  /// @param planes  the last plane of the volume: rays cut off beyond it are not cut off
  BlockRays lanes(double planes);

  const CastAxes& axes() const { return axes_; }

  /// Infinity: no ray.
  float best(int x, int y) const { return best_[index(x, y)]; }

 private:
  static constexpr std::size_t kRays = std::size_t{BlockRays::kTile} * BlockRays::kTile;
  using Column = std::array<float, kRays>;

  static std::size_t index(int x, int y) {
    constexpr int kSide = BlockRays::kSide;
    const int block = y / kSide * BlockRays::kBlocks + x / kSide;
    return static_cast<std::size_t>(block * BlockRays::kRays + y % kSide * kSide + x % kSide);
  }

  CastAxes axes_{};
  Column u_;
  Column v_;
  Column du_;
  Column dv_;
  Column first_plane_;
  Column last_plane_;
  Column best_;
  float latest_first_ = 0.0F;
  float earliest_last_ = 0.0F;
};

}  // namespace nacre

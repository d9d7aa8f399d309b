#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "casting/sample_kernel.h"
#include "reference/bright_bricks.h"
#include "reference/walk_field.h"

namespace nacre {

/// Field units to what kernels take: 0 at the emission map's first knot, 1 at its last.
struct CastScale {
  double lo;
  double inverse;  ///< of the map's width

  float operator()(double field) const { return static_cast<float>((field - lo) * inverse); }
};

inline CastScale cast_scale(const EmissionMap& map) {
  return {map.lo(), 1.0 / (map.hi() - map.lo())};
}

/// The samples of a brick, x fastest.
using BrickValues = std::array<float, CastBrick::kAll>;

/// The samples of all bright bricks, each together: read from the volume a brick lies on 25 lines
/// of memory, which took a quarter of a frame. 500 bytes a brick of 64 cells; where that would be
/// more than 256 MiB, bricks are read from the volume as they are drawn.
class CastBricks {
 public:
  /// On all cores. All arguments outlive this object.
  /// @param most_bytes  bricks are kept if they take no more
  CastBricks(const WalkField& field, const BrightBricks& bright, const CastScale& scale,
             std::size_t most_bytes = std::size_t{256} << 20);

  /// The samples of a bright brick.
  /// @param room  where they are put if they are not kept
  const float* samples(std::size_t brick, BrickValues& room) const;

  /// Asks for the samples ahead of that.
  void prefetch(std::size_t brick) const;

 private:
  const WalkField& field_;
  const BrightBricks& bright_;
  CastScale scale_;
  std::vector<BrickValues> kept_;
};

}  // namespace nacre

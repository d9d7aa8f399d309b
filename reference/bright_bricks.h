#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace nacre {

struct WalkField;

/// A small cube of cells in which a volume can shine, and its greatest sample.
struct BrightBrick {
  glm::ivec3 first_cell{0};
  double greatest = 0.0;  ///< sample, field units
  double emission = 0.0;  ///< of that sample
};

/// All bricks of `kSide`^3 cells with a sample above the emission map's first knot, the brightest
/// first: what a maximum projection has to look at. They are cut off at the volume's border.
///
/// Small, because what they hold is what is drawn: a vessel is a few voxels wide.
struct BrightBricks {
  static constexpr int kSide = 4;

  std::vector<BrightBrick> bricks;  ///< descending by `greatest`, then by position
};

/// One pass over the samples near what is bright, on all cores.
BrightBricks make_bright_bricks(const WalkField& field);

}  // namespace nacre

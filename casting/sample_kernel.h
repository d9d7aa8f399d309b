#pragma once

#include <cstddef>
#include <cstdint>

#include "core/instruction_set.h"

// The inner loop of sampled maxima, compiled once for each instruction set. Plain data only: an
// inline function shared with other sources could be taken from the wrong one.

namespace nacre {

// NOLINTBEGIN(modernize-avoid-c-arrays)

/// The rays of a tile of pixels, blocks of 4 x 4 one after the other, an array for each figure.
///
/// On plane p (a number of cells along the axis that the tile's rays are steepest to) a ray is at
/// u + p du, v + p dv of the other two axes.
struct BlockRays {
  static constexpr int kSide = 4;                ///< pixels along a block's edge
  static constexpr int kRays = kSide * kSide;    ///< of a block
  static constexpr int kTile = 32;               ///< pixels along a tile's edge
  static constexpr int kBlocks = kTile / kSide;  ///< along a tile's edge

  const float* u;
  const float* v;
  const float* du;
  const float* dv;
  const float* first_plane;  ///< planes before it do not count; null if all rays see all planes
  const float* last_plane;
  float* best;  ///< the greatest so far; infinity: no ray
};

/// A brick of up to 4^3 cells, as rays across the planes of an axis take it.
struct CastBrick {
  static constexpr int kSamples = 5;  ///< along an edge
  static constexpr int kAll = kSamples * kSamples * kSamples;
  static constexpr int kFaces = 4;  ///< lower u, upper u, lower v, upper v

  /// Emission before it is clamped, 0 at the map's first knot and 1 at its last; x fastest.
  const float* samples;
  int step[3];      ///< from a sample to the next along u, v and across planes
  float first[3];   ///< the lower corner: u, v, plane
  float extent[3];  ///< cells along u, v and across planes
  unsigned faces;   ///< of the volume's border that are the brick's: a bit each, see `kFaces`
  int sampled;      ///< planes to take samples on, the first being that of the corner
  int per_cell;     ///< planes a cell
  float greatest;   ///< the most that a ray can see of it
};

/// Blocks that a brick may be seen by: x0 <= x < x1, y0 <= y < y1.
struct BlockRectangle {
  int x0;
  int y0;
  int x1;
  int y1;
};

/// What a cued maximum shows: the emission of the map's ends, and the cue within a brick, which is
/// at_corner + rise . (u, v, plane), counted from the brick's corner, and never negative.
struct CastCue {
  float bottom;
  float top;
  float at_corner;
  float rise[3];
  float greatest;  ///< no less than the cue anywhere in the brick
};

/// Raises `best` of the rays through a brick to the greatest of its samples on the sampled planes,
/// each `brick.greatest` at most.
///
/// @param cue  null: none, and `best` is in the samples' unit. Else it is emission times cue, as
///             `brick.greatest` is
using RaiseSamples = void (*)(const BlockRays&, const CastBrick&, const BlockRectangle&,
                              const CastCue* cue);

/// The least `best` within a rectangle of blocks; infinity if it is empty.
using LeastOfBlocks = float (*)(const BlockRays&, const BlockRectangle&);

/// The most planes a cell that kernels take samples on.
constexpr int kMostSamplesPerCell = 16;

struct SampleKernel {
  RaiseSamples raise;
  LeastOfBlocks least_best;
};
// NOLINTEND(modernize-avoid-c-arrays)

/// @pre the processor has the set
SampleKernel sample_kernel_for(InstructionSet set) noexcept;

}  // namespace nacre

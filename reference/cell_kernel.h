#pragma once

#include <cstddef>

#include "core/instruction_set.h"

// The inner loop of the exact maximum by cells, compiled once for each instruction set. Plain data
// only: an inline function shared with other sources could be taken from the wrong one.

namespace nacre {

// NOLINTBEGIN(modernize-avoid-c-arrays)

/// The samples of a brick of up to 4^3 cells, in field units.
struct BrickSamples {
  static constexpr int kCells = 4;    ///< along an edge
  static constexpr int kSamples = 5;  ///< along an edge

  double sample[kSamples * kSamples * kSamples];  ///< x fastest
  double first_cell[3];                           ///< the lower corner, cell coordinates
};

/// Rays of a tile of pixels, an array for each figure, rows of `stride`. Past a row's end there
/// is at least one vector of rays that see nothing.
///
/// A ray is origin + t * direction in cell coordinates, t_begin <= t <= t_end.
struct LaneRays {
  const double* origin[3];
  const double* direction[3];
  const double* inverse[3];  ///< 1 / direction; `kNever` along an axis of direction 0
  const double* slack[3];    ///< 0, along an axis of direction 0 `kSlack`; null if all are 0
  const double* t_begin;
  const double* t_end;
  double* best;             ///< the greatest so far
  const double* beta_at;    ///< the cue at t = 0; for `visit_parts` only
  const double* beta_rise;  ///< and its rise with t
  std::size_t stride;

  /// So large that (plane - origin) * kNever is far beyond kSlack, unless the ray is in the plane.
  static constexpr double kNever = 1e280;
  static constexpr double kSlack = 1e140;
};

/// A part of a ray in a cell: the field's Bernstein coefficients, and where it is.
struct CellPart {
  double b[4];
  double t_enter;
  double t_exit;
};

/// Rows of rays that a cell may be seen by: x0 <= x < x1, y0 <= y < y1.
struct LaneRectangle {
  int x0;
  int y0;
  int x1;
  int y1;
};

/// A cell of a brick: its place in it, each from 0 to 3, and the greatest that it can reach.
struct BrickCell {
  int x;
  int y;
  int z;
  double greatest;
};

/// Raises `best` of the rays through a cell, to the field's maximum in it (nothing is done for rays
/// that `cell.greatest` does not exceed).
using RaiseMaxima = void (*)(const LaneRays&, const BrickSamples&, const BrickCell&,
                             const LaneRectangle&);

/// A line that no value of an emission map above its lowest exceeds: T(v) <= at_0 + slope * v.
struct EmissionBound {
  double at_0;
  double slope;
};

/// Where an emission map begins and ends. One of one linear piece kernels take at the ends of a
/// part themselves, as `EmissionMap` does, operation by operation.
struct MapEnds {
  double lo;
  double hi;
  double width;   ///< hi - lo, finite if it is one piece
  double bottom;  ///< emission up to lo
  double top;     ///< emission from hi on
  bool is_one_piece;
};

/// What to do with a part of a ray.
struct PartVisitor {
  void (*visit)(void* context, std::size_t ray, const CellPart& part);
  void* context;
};

/// Raises `best` of the rays through a cell to the cued emission at the ends of their parts (where
/// the map is one piece), and visits each ray, by its place in the arrays, whose cued emission may
/// exceed its best still: `cell.greatest` (an emission times a cue) does, and so does a coefficient
/// of the bound times the cue.
///
/// @pre  best is no less than the map's lowest times the cue anywhere on the ray
using VisitParts = void (*)(const LaneRays&, const BrickSamples&, const BrickCell&,
                            const LaneRectangle&, const EmissionBound&, const MapEnds&,
                            const PartVisitor&);
// NOLINTEND(modernize-avoid-c-arrays)

/// The greatest corner of each of a brick's 4^3 cells, x fastest; returns one bit a cell, set where
/// it exceeds `floor`.
using GreatestCorners = unsigned long long (*)(const BrickSamples&, double floor,
                                               double greatest[64]);

/// The least `best` within a rectangle; infinity if it is empty.
using LeastBest = double (*)(const LaneRays&, const LaneRectangle&);

struct CellKernel {
  LeastBest least_best;
  GreatestCorners greatest_corners;
  RaiseMaxima raise_maxima;
  VisitParts visit_parts;
};

/// @pre the processor has the set
CellKernel cell_kernel_for(InstructionSet set) noexcept;

/// `maximum` of a cubic, for the kernels.
double maximum_of(const CellPart& part) noexcept;

}  // namespace nacre

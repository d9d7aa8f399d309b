#pragma once

#include "core/triangle_mesh.h"

namespace nacre {

/// A length known to lie between two bounds, mm.
struct BoundedDistance {
  double lower_mm = 0.0;
  double upper_mm = 0.0;
};

/// The one-sided Hausdorff distance: how far the farthest point of `from` is from `to`.
///
/// Lower bounds are distances of points, upper bounds come from the convexity of the distance to a
/// triangle: a piece whose corners are all within r of one triangle of `to` is within r of it
/// (docs/derivations.md, "A bounded Hausdorff distance"). Pieces are cut until the bounds are
/// `error_mm` apart. Both bounds are the same for any number of threads.
///
/// @param error_mm  positive: how far apart the bounds may be
/// @return          0 and 0 if `from` is empty, infinity if only `to` is
BoundedDistance hausdorff_distance(const TriangleMesh& from, const TriangleMesh& to,
                                   double error_mm);

}  // namespace nacre

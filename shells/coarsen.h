#pragma once

#include <glm/mat3x3.hpp>

#include "core/triangle_mesh.h"
#include "shells/surface_field.h"

namespace nacre {

struct CoarsenOptions {
  /// Bound of |field| over what is changed, sampled; triangles that have more stay as they are, or
  /// give way to such that keep it.
  double error_tolerance = 0.0;
  /// Turns offsets on a triangle into numbers of samples: voxels from mm.
  glm::dmat3 samples_from_mm{1.0};
  /// How far the field's detail reaches: its least spacing.
  double spacing_mm = 1.0;
};

/// A surface with far fewer triangles, several times as soon as `simplify` would give it.
///
/// Edges are collapsed to where the field's quadrics (`FieldQuadrics`) are least. Where `simplify`
/// always takes the cheapest edge next and fits the vertex to the field, this goes through the
/// edges in their own order, a few times with a rising bound: no queue, neighbours in memory follow
/// each other, and a place is taken if the field's samples are within the tolerance there, or not
/// at all. Closed, oriented and manifold before and after every collapse, with triangles of the
/// shape that `simplify` keeps (docs/decisions/024-coarse-copies.md).
///
/// @param surface  closed, oriented, manifold
/// @param field    what it should be a zero of, in its frame
/// @throws Error   BadArgument if it is not
///
/// One thread; the result depends on nothing else. About a microsecond a triangle.
TriangleMesh coarsen(const TriangleMesh& surface, const SurfaceField& field,
                     const CoarsenOptions& options);

}  // namespace nacre

#pragma once

#include <cstddef>

#include "core/triangle_mesh.h"
#include "shells/surface_field.h"

namespace nacre {

struct RefineOptions {
  /// Edges whose middle, and triangles whose centre, has a larger |field| are divided.
  double error_tolerance = 0.01;
  /// A new vertex goes no farther from the middle of its edge than this.
  double reach_mm = 1.0;
  int rounds = 1;  ///< each halves the edges that need it
};

/// Divides the triangles of a surface where it strays from the field that it should be a zero of:
/// a vertex in the middle of an edge, moved to the field's zero along its gradient (Newton).
///
/// Contouring follows the field at lattice edges only: a vessel thinner than a voxel comes out as a
/// prism inside of it. Closed, oriented, manifold as the surface is: an edge is divided for both
/// its triangles or for none, into two, three or four. No part of a triangle turns over against it:
/// new vertices go less far then.
///
/// @param surface  closed, oriented, manifold
/// @param field    in its frame
/// @throws Error   BadArgument if it is not
///
/// The vertices of the surface come first, unmoved. O(triangles) a round.
TriangleMesh refine(const TriangleMesh& surface, const SurfaceField& field,
                    const RefineOptions& options);

}  // namespace nacre

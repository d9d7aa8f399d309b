#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>

#include "core/triangle_mesh.h"

namespace nacre {

/// Deviation of a surface from what it should be, at a point in its own frame.
using SurfaceError = std::function<double(const glm::dvec3& p_mm)>;

/// What simplification must keep. Every bound that is given holds; without any, and without a
/// target, a surface stays as it is.
struct SimplifyOptions {
  /// Bound of the distance between the surfaces before and after, either way, sampled. 0: none.
  double tolerance_mm = 0.0;

  /// Bound of `error` over the surface, sampled: a triangle stays within it, or within what the one
  /// it replaces had. Used if `error` is given; then 0 allows what costs nothing.
  double error_tolerance = 0.0;
  SurfaceError error = {};
  /// Distance of the samples on a triangle: the field's least spacing.
  double sample_spacing_mm = 1.0;

  /// Stop at this many triangles; 0: only at the bounds.
  std::size_t target_triangles = 0;
};

/// A surface with fewer triangles: edges collapsed in the order of their quadric error (Garland,
/// Heckbert 1997, "Surface Simplification Using Quadric Error Metrics"), with OpenMesh's decimater.
///
/// Vertices stay where they are or vanish. Closed, oriented and manifold before and after every
/// collapse; no triangle turns by more than some 75 degrees or becomes a sliver.
///
/// @param surface  closed, oriented, manifold; one without area is not improved
/// @throws Error   BadArgument if it is not closed and manifold
///
/// One thread a surface; the result depends on nothing else. About 20 microseconds a vertex.
TriangleMesh simplify(const TriangleMesh& surface, const SimplifyOptions& options);

}  // namespace nacre

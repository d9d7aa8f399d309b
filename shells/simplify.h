#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <optional>

#include "core/shell_set.h"
#include "core/triangle_mesh.h"
#include "shells/border_rounding.h"
#include "shells/star_fit.h"
#include "shells/surface_field.h"

namespace nacre {

/// What simplification must keep. Every bound that is given holds; without any, and without a
/// target, a surface stays as it is.
struct SimplifyOptions {
  /// Bound of the distance between the surfaces before and after, either way, sampled. 0: none.
  double tolerance_mm = 0.0;

  /// Bound of |field| over the surface, sampled: a triangle stays within it, or within what the
  /// ones it replaces had. Used if `field` is given; then 0 allows what costs nothing.
  double error_tolerance = 0.0;
  /// What the surface should be a zero of.
  SurfaceField field = {};
  /// Turns offsets on a triangle into numbers of samples: voxels from mm.
  glm::dmat3 samples_from_mm{1.0};
  /// How far the field's detail reaches: its least spacing. No vertex goes farther at a time.
  double spacing_mm = 1.0;
  /// How much keeping the volume inside counts beside following the field (`StarFit`).
  double volume_weight = StarFit::kVolumeWeight;

  /// Vertices end on this grid, at those of its points from where the triangles follow the field
  /// best: an error that rounding each coordinate by itself would make several times larger.
  std::optional<QuantizationGrid> grid = {};
  /// For that grid; must outlive the call. Null: there are no border planes.
  const BorderRounding* border = nullptr;

  /// Stop at this many triangles; 0: only at the bounds.
  std::size_t target_triangles = 0;
};

/// A surface with fewer triangles: edges collapsed in the order of their quadric error (Garland,
/// Heckbert 1997, "Surface Simplification Using Quadric Error Metrics"), each to the point from
/// where the triangles about it follow the field best (`StarFit`). The quadrics are the field's
/// own: of its tangent planes at the triangles' centres, by its gradient in units of its error.
///
/// Closed, oriented and manifold before and after every collapse; no triangle turns by more than
/// some 75 degrees or becomes a sliver.
///
/// @param surface  closed, oriented, manifold
/// @throws Error   BadArgument if it is not
///
/// One thread; the result depends on nothing else.
TriangleMesh simplify(const TriangleMesh& surface, const SimplifyOptions& options);

}  // namespace nacre

#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "core/shell_set.h"
#include "shells/border_rounding.h"
#include "shells/closed_mesh.h"
#include "shells/star_fit.h"
#include "shells/surface_field.h"

namespace nacre {

/// Moves a surface's vertices to points of a grid from where its triangles follow a field best.
///
/// Of the 27 grid points around a vertex the one with the least sum of squared errors over its
/// triangles (`StarFit`, to second order), vertex by vertex: along the surface a vertex is free to
/// move, so that one of them is nearly on the level where the nearest, rounded coordinate by
/// coordinate, is up to a step off. Beside caps it is the nearest, and in the volume's border
/// planes, where caps must stay, the nearest outwards.
///
/// @param positions   of the mesh's vertices, in the grid's frame; moved by at most 1.5 steps along
///                    each axis, or 2.5 where a step crosses more than a tenth of a sample
/// @param samples_from_mm, volume_weight  of `StarFit`
/// @param border      for that grid; null: there are no border planes
///
/// Two vertices may come to share a point, and a triangle that lies across a step may lose its
/// area: `snap` resolves both. O(vertices), in the order of the vertices; where a step is that
/// coarse they are gone over twice.
void fit_to_grid(const ClosedMesh& mesh, const SurfaceField& field,
                 const glm::dmat3& samples_from_mm, const QuantizationGrid& grid,
                 std::span<glm::dvec3> positions, double volume_weight = StarFit::kVolumeWeight,
                 const BorderRounding* border = nullptr);

}  // namespace nacre

#pragma once

#include <array>
#include <cstdint>

#include "extract/cell_topology.h"

namespace nacre {

/// The contour's polygons on the boundary of a cell, and the boundary's connected parts.
///
/// On every face the contour runs from the edge where the face's outline (counter-clockwise from
/// outside) enters the set to the one where it leaves it; linked across faces these segments close
/// into loops.
///
/// @param mask          the corners inside
/// @param joined_faces  bit f: in face f, if ambiguous, the inside corners are joined
CellCase trace_cell(unsigned mask, unsigned joined_faces);

/// True if the inside corners of the face are exactly two diagonal ones.
bool is_ambiguous(unsigned mask, const CellFace& face);

/// Fills the loop's triangles: of all triangulations that keep off the faces, the one with the
/// shortest inner edges, vertices taken at the middle of their cell edges.
void triangulate(CellLoop& loop);

}  // namespace nacre

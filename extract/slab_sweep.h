#pragma once

#include <cstddef>
#include <span>

#include "extract/cell_contours.h"
#include "extract/lattice_slice.h"
#include "extract/lattice_vertices.h"
#include "extract/level_output.h"
#include "extract/stored_levels.h"
#include "extract/sweep_grid.h"

namespace nacre {

/// What one thread needs to sweep a slab: two slices, the gap between them, and the numbers of the
/// vertices so far.
struct SweepWorkspace {
  explicit SweepWorkspace(const SweepGrid& grid)
      : lower(grid.dims[0], grid.dims[1]),
        upper(grid.dims[0], grid.dims[1]),
        gap(grid.dims[0], grid.dims[1]) {}

  LatticeSlice lower;
  LatticeSlice upper;
  LatticeGap gap;
  VertexIds ids;
};

/// The cell layers [begin, end) of a volume: between slices begin and end.
struct Slab {
  std::size_t begin;
  std::size_t end;
};

/// Sweeps one slab from its lowest slice up, all levels at once.
///
/// @param output  the slab's part of each level's surface; empty before
/// @throws Error  Unsupported where the slab holds 2^32 vertices
template <class T>
void sweep_slab(const Slab& slab, const LatticeVertices<T>& vertices, const CellContours& contours,
                const SweepGrid& grid, SweepWorkspace& workspace, SlabOutput& output);

}  // namespace nacre

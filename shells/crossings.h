#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/shell_set.h"
#include "shells/surface_emission.h"

namespace nacre {

/// The triangles of a shell that may meet its neighbours, by the emissions they span.
struct StrayTriangles {
  std::vector<std::uint32_t> inwards;   ///< reach half-way to the next level, or farther
  std::vector<std::uint32_t> outwards;  ///< likewise to the level before
  double lo = 1.0;                      ///< bounds of the emission off the border planes
  double hi = 0.0;                      ///< lo > hi where there are no triangles
};

/// Finds a shell's stray triangles. Where two surfaces meet the emission is one, so that a triangle
/// of shell k that meets one of shell k + 1 reaches (t_k + t_(k+1)) / 2, or the other one does.
///
/// Caps (triangles in a border plane) are left out: they touch, and do not cross.
///
/// @param below, above  the emission half-way to the neighbours' levels
/// @param step_mm       of the grid
StrayTriangles find_stray_triangles(const TriangleMesh& surface, const TrilinearField& field,
                                    const EmissionMap& emission, double below, double above,
                                    double step_mm);

/// How a shell and the next that is not empty meet.
struct NeighbourCrossings {
  std::size_t outer = 0;    ///< index of the shell
  std::size_t inner = 0;    ///< index of the next
  bool impossible = false;  ///< their emissions are disjoint
  std::size_t pairs = 0;  ///< of triangles that cross: each has corners on both sides of the other
};

/// Counts the crossings of neighbours, exactly: positions are grid points, predicates integers.
/// Caps that touch in a border plane do not cross.
///
/// @param set     snapped to its grid
/// @param strays  one a shell
/// O(triangles) for the search, about 0.1 microseconds each.
std::vector<NeighbourCrossings> count_crossings(const ShellSet& set,
                                                const std::vector<StrayTriangles>& strays);

}  // namespace nacre

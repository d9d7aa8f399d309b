#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "core/shell_set.h"

namespace nacre {

/// How a shell and the next that is not empty meet.
struct NeighbourCrossings {
  std::size_t outer = 0;  ///< index of the shell
  std::size_t inner = 0;  ///< index of the next
  std::size_t pairs = 0;  ///< of triangles that cross: each has corners on both sides of the other
};

/// Gives a shell's surface, on the set's grid. Called by several threads at a time.
using SurfaceOfShell = std::function<TriangleMesh(std::size_t shell)>;

/// Counts where neighbouring shells cross, exactly: positions are grid points, predicates integers.
/// Caps in the volume's border planes are left out: they lie on each other.
///
/// Plain code without CGAL, cheap enough for every build; `mutual_intersections` is its independent
/// check. Of each surface that is waiting or being counted it holds 18 bytes a triangle, and the
/// surface itself while it is made.
///
/// @param set         its grid and its volume; its surfaces are not looked at
/// @param shells      those that are not empty, from the outermost inwards
/// @param surface_of  what it throws ends the count
/// @param at_once     so many surfaces are in the making, waiting or being counted; 1 at least
/// @param progress    stage "nesting"
/// @return            one for each shell but the first
std::vector<NeighbourCrossings> count_neighbour_crossings(const ShellSet& set,
                                                          std::span<const std::size_t> shells,
                                                          const SurfaceOfShell& surface_of,
                                                          std::size_t at_once,
                                                          const ProgressCallback& progress = {});

}  // namespace nacre

#pragma once

#include "core/progress.h"
#include "core/shell_set.h"

namespace nacre {

struct PruneOptions {
  /// Components of less volume, with either sign, are specks; 0 keeps them.
  double min_component_mm3 = 0.0;
  /// Leaves out components inside an outer surface of their own shell: cavities, and what lies
  /// within them.
  bool prune_inner = false;
  ProgressCallback progress = {};  ///< stage "prune"
};

/// Leaves closed components out of a set's surfaces.
///
/// *Specks* are islands, and cavities, of less volume than a bound. A ray through a speck of shell
/// k loses r_k down to what the shells around it show, if it meets nothing as bright elsewhere: the
/// largest such loss is reported. Cavities of that size are filled, which a maximum projection
/// does not show.
///
/// *Inner components*: a ray from outside that meets a component inside a closed surface of the
/// same shell meets that surface, too, nearer and farther. So no maximum projection shows it that
/// starts outside the volume and has no slab; sums, counts, slabs and eyes within the volume do.
///
/// What is left is closed, oriented and manifold as before; vertices and triangles keep their
/// order.
///
/// @param set  surfaces closed; shells nested as level sets are
/// @return     what was left out
/// O(triangles) for the components; inner ones cost a search of one column of triangles each.
Pruning prune(ShellSet& set, const PruneOptions& options);

}  // namespace nacre

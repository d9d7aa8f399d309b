#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/emission.h"
#include "core/progress.h"
#include "core/shell_set.h"
#include "core/volume.h"
#include "extract/levels.h"
#include "shells/crossings.h"
#include "shells/snap.h"

namespace nacre {

struct BuildOptions {
  std::vector<Level> levels;          ///< strictly ascending
  std::string placement = "uniform";  ///< of `ShellSet`
  double emission_tolerance = 0.0;    ///< of the surfaces; 0: no simplification by it
  double tolerance_mm = 0.0;          ///< likewise, of their distance
  std::size_t target_triangles = 0;   ///< for the set, shared out evenly; 0: none
  int quantization_bits = 0;          ///< 0 chooses, see `choose_grid`
  double min_component_mm3 = 0.0;     ///< specks, see `PruneOptions`
  bool prune_inner = false;           ///< components inside their own shell, see `PruneOptions`
  ProgressCallback progress = {};     ///< stages "extract", "prune", "simplify", "snap"
};

/// What a build took, and what it left.
struct BuildReport {
  std::size_t extracted_triangles = 0;
  std::size_t triangles = 0;
  SnapReport snapped;
  std::vector<NeighbourCrossings> crossings;  ///< of each shell and the next
  double step_spacings = 0.0;                 ///< of the grid, as a part of the smallest spacing
  bool is_grid_coarse = false;                ///< see `GridChoice`
  double extract_seconds = 0.0;
  double prune_seconds = 0.0;
  double simplify_seconds = 0.0;
  double snap_seconds = 0.0;
  double crossings_seconds = 0.0;
};

struct BuiltShells {
  ShellSet set;
  BuildReport report;
};

/// The shells of a volume: contoured, simplified, snapped to one grid and cleaned, ready to be
/// written.
///
/// Specks and inner components are left out if the options say so (`ShellSet::pruned`), and the
/// crossings of neighbours are counted. Every shell is closed, oriented, manifold and without
/// degenerate triangles (`snap`), or empty where nothing reaches its level. The same for any number
/// of threads.
///
/// @param emission  rising, see `extract/emission_volume.h` for maps that fall
/// @throws Error    BadArgument if the levels do not ascend within (0, T(infinity)] or two have the
///                  same value, or the grid is too coarse; as `extract_surfaces` and `choose_grid`
BuiltShells build_shells(const Volume& volume, const EmissionMap& emission,
                         const BuildOptions& options);

/// The same, freeing the volume as soon as no later step looks at it: the surfaces are compressed
/// without it beside them in memory.
BuiltShells build_shells(Volume&& volume, const EmissionMap& emission, const BuildOptions& options);

}  // namespace nacre

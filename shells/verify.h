#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/emission.h"
#include "core/progress.h"
#include "core/shell_set.h"
#include "core/volume.h"
#include "shells/hausdorff.h"
#include "shells/mesh_intersections.h"
#include "shells/shell_checks.h"
#include "shells/surface_emission.h"

namespace nacre {

/// A shell and the next larger level's that is not empty, off the volume's border planes, where all
/// shells are capped and their caps lie on each other.
struct NeighbourReport {
  std::size_t inner = 0;  ///< index of the other shell
  MutualIntersections intersections;
  /// Smallest distance of a vertex of either to the other, mm; 0 where they cross.
  double gap_mm = 0.0;
};

/// What a shell is, from its triangles alone.
struct ShellVerdict {
  ShellReport topology;
  std::size_t off_grid = 0;  ///< positions that are not on the set's grid
  std::size_t self_intersections = 0;
  std::optional<NeighbourReport> next;  ///< none for the innermost
};

/// What a shell is beside the volume it was made from.
struct VolumeVerdict {
  SurfaceEmission emission;
  /// Bound of what contouring itself leaves: of the shell made anew, not simplified.
  double extraction_error_bound = 0.0;
  BoundedDistance to_unsimplified;    ///< the farthest the shell strays from the one made anew
  BoundedDistance from_unsimplified;  ///< the farthest that one strays from it
  bool tolerance_kept = true;
};

struct VerifyOptions {
  bool neighbours = true;          ///< whether shells are nested: intersections and gaps
  ProgressCallback progress = {};  ///< stage "verify"
};

/// Checks the surfaces of a set: what `check_shell` counts, positions off the grid (if the set has
/// one), self-intersections and intersections of neighbours by exact predicates (CGAL), and the
/// gap between neighbours.
///
/// About 10 microseconds a triangle and thread.
std::vector<ShellVerdict> verify_surfaces(const ShellSet& set, const VerifyOptions& options = {});

/// Measures the surfaces of a set against its volume and against the shells made anew.
///
/// A tolerance is kept if no sample is off by more than it, or than contouring itself leaves
/// somewhere on that shell, beside what snapping accounts for.
///
/// @param volume    of the set's dims
/// @param progress  stages "extract", "measure"
/// @throws Error    as `extract_surfaces`
std::vector<VolumeVerdict> verify_against_volume(const ShellSet& set, const Volume& volume,
                                                 const ProgressCallback& progress = {});

/// What a shell breaks of what every shell promises: "3 open edges", ... Nothing if it is sound.
std::vector<std::string> broken_promises(const ShellVerdict& verdict);

}  // namespace nacre

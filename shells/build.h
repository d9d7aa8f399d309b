#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/emission.h"
#include "core/progress.h"
#include "core/shell_set.h"
#include "core/tolerance_weight.h"
#include "core/volume.h"
#include "extract/levels.h"
#include "shells/snap.h"

namespace nacre {

struct BuildOptions {
  std::vector<Level> levels;          ///< strictly ascending
  std::string placement = "uniform";  ///< of `ShellSet`
  double emission_tolerance = 0.0;    ///< of the surfaces; 0: no simplification by it
  ToleranceWeight tolerance_weight = ToleranceWeight::Field;
  double tolerance_mm = 0.0;         ///< likewise, of their distance
  std::size_t target_triangles = 0;  ///< for the set, shared out evenly; 0: none
  int quantization_bits = 0;         ///< 0 chooses, see `choose_grid`
  double min_component_mm3 = 0.0;    ///< specks are left out, see `PruneOptions`
  bool prune_inner = false;          ///< components inside their own shell, see `PruneOptions`
  /// Emission error of the coarser copies that a simplified set gets beside its shells; 0: none.
  double coarse_tolerance = 0.0;
  /// Only a set of more triangles than this gets them.
  std::size_t coarse_above_triangles = 0;
  /// Folder of a nameless file where large surfaces wait for their turn; none: memory holds them.
  std::optional<std::filesystem::path> scratch_folder = {};
  ProgressCallback progress = {};  ///< stages "extract", "simplify", "coarsen", "snap"
};

/// What a build took, and what it left.
struct BuildReport {
  std::size_t extracted_triangles = 0;
  std::size_t triangles = 0;
  SnapReport snapped;
  double step_spacings = 0.0;   ///< of the grid, as a part of the smallest spacing
  bool is_grid_coarse = false;  ///< see `GridChoice`
  double extract_seconds = 0.0;
  double simplify_seconds = 0.0;
  double coarsen_seconds = 0.0;
  double snap_seconds = 0.0;
  double sink_seconds = 0.0;  ///< in the sink, its share of the time that snapping and it took
};

struct BuiltShells {
  ShellSet set;
  /// The coarser copies, one a shell, if any were made: closed and on the grid as the shells are.
  std::vector<TriangleMesh> copies = {};
  BuildReport report = {};
};

/// The shells of a volume: contoured, simplified, snapped to one grid and cleaned, ready to be
/// written.
///
/// Every shell is closed, oriented, manifold and without degenerate triangles (`snap`), or empty
/// where nothing reaches its level. The same for any number of threads.
///
/// @param emission  rising, see `extract/emission_volume.h` for maps that fall
/// @throws Error    BadArgument if the levels do not ascend within (0, T(infinity)] or two have the
///                  same value, or the grid is too coarse; as `extract_surfaces` and `choose_grid`
BuiltShells build_shells(const Volume& volume, const EmissionMap& emission,
                         const BuildOptions& options);

/// The same, freeing the volume as soon as no later step looks at it.
BuiltShells build_shells(Volume&& volume, const EmissionMap& emission, const BuildOptions& options);

/// Takes a finished surface, shell `k` of the set, away: to compress it, say. Called once with each
/// that is not empty, from several threads at a time; nothing of the set changes but its surfaces.
using SurfaceSink = std::function<void(const ShellSet& set, std::size_t k, TriangleMesh&& surface)>;

/// The same for a set too large to stand in memory: each surface goes to the sink when it is
/// finished, and that of the set returned is empty. With a scratch folder, memory holds little more
/// than the volume and then, that being freed, as many surfaces as fit in its place, at least one
/// (docs/decisions/006).
BuiltShells build_shells(Volume&& volume, const EmissionMap& emission, const BuildOptions& options,
                         const SurfaceSink& sink);

/// The same, the volume staying where it is: for one that several sets are built from.
BuiltShells build_shells(const Volume& volume, const EmissionMap& emission,
                         const BuildOptions& options, const SurfaceSink& sink);

}  // namespace nacre

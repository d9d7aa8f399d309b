#pragma once

#include <glm/mat4x4.hpp>
#include <utility>

#include "app/level_placement.h"
#include "app/shell_building.h"
#include "shells/build.h"

namespace nacre {

/// How the flags want these levels built; not where surfaces wait.
BuildOptions build_options(const ShellFlags& flags, const glm::dmat4& world_from_voxel,
                           PlacedLevels levels, ProgressCallback progress);

/// Draco's effort, named or chosen.
int compression_of(const ShellFlags& flags);

/// A compressed set, and what building it took.
struct BuiltSet {
  CompressedSet compressed;
  BuildReport report;
};

/// Builds, compressing each shell when it is finished. A volume that is moved here is gone as soon
/// as no later step looks at it.
///
/// @param compression  see `ShellWriteOptions`
BuiltSet build_and_compress(Volume&& volume, const EmissionMap& emission,
                            const BuildOptions& options, int compression);
BuiltSet build_and_compress(const Volume& volume, const EmissionMap& emission,
                            const BuildOptions& options, int compression);

/// Leaves out copies that would make the file too much larger for what was not asked for, and says
/// so.
void drop_large_copies(CompressedSet& built, Reporter& reporter);

/// Says what came of a build, and notes it.
void tell_build(const ShellSet& set, const BuildReport& report, Reporter& reporter,
                BuildFigures& figures);

/// Counts where neighbours cross as they will decode: a few at a time are in memory.
void count_crossings_of(const CompressedSet& built, Reporter& reporter, BuildFigures& figures);

}  // namespace nacre

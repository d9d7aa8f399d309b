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

/// A compressed set, and what building it took.
struct BuiltSet {
  CompressedSet compressed;
  BuildReport report;
};

/// The emission error of coarse copies that the flags ask for, 0 for none.
/// @param triangles  set to what a set must have more of to get them
/// @throws Error     BadArgument for a tolerance out of range, or where shells are not simplified
double coarse_tolerance(const ShellFlags& flags, std::size_t levels, std::size_t& triangles);

/// Builds, compressing each shell when it is finished. A volume that is moved here is gone as soon
/// as no later step looks at it.
BuiltSet build_and_compress(Volume&& volume, const EmissionMap& emission,
                            const BuildOptions& options);
BuiltSet build_and_compress(const Volume& volume, const EmissionMap& emission,
                            const BuildOptions& options);

/// Says what came of a build, and notes it.
void tell_build(const ShellSet& set, const BuildReport& report, Reporter& reporter,
                BuildFigures& figures);

/// Counts where neighbours cross as they will decode: two at a time are in memory.
void count_crossings_of(const CompressedSet& built, Reporter& reporter, BuildFigures& figures);

}  // namespace nacre

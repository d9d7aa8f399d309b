#include "app/shell_building.h"

#include <utility>

#include "app/level_placement.h"
#include "app/set_building.h"
#include "shells/build.h"

namespace nacre {
namespace {

BuildOptions options_of(const ShellFlags& flags, const EmissionVolume& input, Reporter& reporter,
                        BuildFigures& figures) {
  Stopwatch placing;
  PlacedLevels placed = LevelPlacer(input).place(flags, reporter, figures.placement);
  figures.emission = placing.lap();
  return build_options(flags, input.volume.world_from_voxel, std::move(placed),
                       reporter.progress());
}

}  // namespace

ShellSet build_shell_set(const ShellFlags& flags, EmissionVolume input, Reporter& reporter,
                         BuildFigures& figures) {
  const BuildOptions options = options_of(flags, input, reporter, figures);
  BuiltShells built = build_shells(std::move(input.volume), input.emission, options);
  tell_build(built.set, built.report, reporter, figures);
  return std::move(built.set);
}

CompressedSet build_compressed_set(const ShellFlags& flags, EmissionVolume input,
                                   const std::filesystem::path& scratch_folder, Reporter& reporter,
                                   BuildFigures& figures) {
  BuildOptions options = options_of(flags, input, reporter, figures);
  options.scratch_folder = scratch_folder;
  BuiltSet built =
      build_and_compress(std::move(input.volume), input.emission, options, compression_of(flags));
  if (flags.coarse == kAutoCopies) drop_large_copies(built.compressed, reporter);
  tell_build(built.compressed.set, built.report, reporter, figures);
  count_crossings_of(built.compressed, reporter, figures);
  return std::move(built.compressed);
}

CompressedSet build_one_level(const ShellFlags& flags, const EmissionVolume& input,
                              double emission) {
  const BuildOptions options =
      build_options(flags, input.volume.world_from_voxel, {{{emission, 1.0}}, "explicit"}, {});
  CompressedSet result;
  result.set = build_shells(input.volume, input.emission, options).set;
  TriangleMesh surface = std::exchange(result.set.shells.front().surface, {});
  result.shells.resize(1);
  if (!surface.triangles.empty()) {
    result.shells.front() = pack_shell(std::move(surface), *result.set.grid);
  }
  return result;
}

bool is_simplifying(const ShellFlags& flags) {
  return flags.tolerance.value_or(0.0) > 0.0 || flags.tolerance_mm > 0.0;
}

}  // namespace nacre

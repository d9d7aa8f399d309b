#include "report/shell_error.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <utility>

#include "core/emission.h"
#include "core/error.h"
#include "extract/marching_cubes.h"
#include "reference/exact_picture.h"
#include "reference/exact_walk.h"
#include "shells/snap.h"
#include "shells/voxel_checksum.h"

namespace nacre {
namespace {

/// Puts the surfaces of the set's levels into it, as they come from the volume.
void extract_anew(const Volume& volume, ShellSet& set, const ProgressCallback& progress) {
  std::vector<double> values;
  for (const Shell& shell : set.shells) values.push_back(shell.value);
  std::vector<TriangleMesh> surfaces = extract_surfaces(volume, values, progress);
  for (std::size_t k = 0; k < surfaces.size(); ++k) set.shells[k].surface = std::move(surfaces[k]);
}

void snap_all(ShellSet& set) {
  const BorderRounding border(set);
  tbb::parallel_for(std::size_t{0}, set.shells.size(), [&](std::size_t k) {
    set.shells[k].surface = snap(set.shells[k].surface, *set.grid, &border).mesh;
  });
}

std::vector<ShownLevel> shown_levels(const ShellSet& set, const ShellPictureOptions& options) {
  const bool sum = options.mode == PictureMode::Sum;
  std::vector<ShownLevel> levels;
  for (std::uint32_t k = 0; k < set.shells.size(); ++k) {
    if (std::ranges::find(options.hidden, k) != options.hidden.end()) continue;
    const Shell& shell = set.shells[k];
    levels.push_back({shell.value, sum ? sum_representative(shell) : shell.representative});
  }
  return levels;
}

}  // namespace

void check_same_volume(const Volume& volume, const VolumeFacts& facts) {
  if (volume.dims != facts.dims || volume.type != facts.type) {
    // A map that falls is applied to the volume first, which makes it one of floats.
    const bool may_be_mapped = volume.dims == facts.dims && facts.type == ScalarType::F32;
    throw Error(
        ErrorCode::BadArgument,
        fmt::format("volume: found {} x {} x {} samples of {}, expected {} x {} x {} of {}, "
                    "which the shell set was made from{}",
                    volume.dims.x, volume.dims.y, volume.dims.z, name(volume.type), facts.dims.x,
                    facts.dims.y, facts.dims.z, name(facts.type),
                    may_be_mapped ? " (if by a --map that falls: with that --map)" : ""));
  }
  const std::uint64_t checksum = voxel_checksum(volume);
  if (checksum != facts.checksum) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("volume: found samples with the checksum {:016x}, expected {:016x}, "
                            "which the shell set was made from",
                            checksum, facts.checksum));
  }
}

ShellErrorChain shell_error_chain(Volume volume, ShellSet set, const Camera& camera,
                                  const ShellPictureOptions& options,
                                  const ProgressCallback& progress) {
  check_same_volume(volume, set.volume);
  if (!set.grid) {
    throw Error(ErrorCode::BadArgument, "shell set: found no quantisation grid, expected one");
  }
  volume.slope = set.volume.slope;
  volume.intercept = set.volume.intercept;
  volume.world_from_voxel = set.volume.world_from_voxel;
  const auto picture_of_set = [&] { return shell_picture(set, camera, options, progress).volume; };
  Image simplified = picture_of_set();
  for (Shell& shell : set.shells) shell.surface = {};

  ShellErrorChain chain;
  const ExactWalk walk(volume, EmissionMap::piecewise_linear(set.emission));
  const ExactPictureOptions exact{options.mode, options.cue, options.slab,
                                  shown_levels(set, options), options.tools};
  chain.truth = exact_picture(walk, camera, exact, progress).volume;
  if (options.mode == PictureMode::Max || options.mode == PictureMode::Sum) {
    chain.stages.push_back({"levels", ideal_picture(walk, camera, exact, progress).volume});
  }
  extract_anew(volume, set, progress);
  chain.stages.push_back({"contouring", picture_of_set()});
  snap_all(set);
  chain.stages.push_back({"vertex quantisation", picture_of_set()});
  chain.stages.push_back({"simplification", std::move(simplified)});
  return chain;
}

}  // namespace nacre

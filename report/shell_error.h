#pragma once

#include <vector>

#include "core/camera.h"
#include "core/image.h"
#include "core/progress.h"
#include "core/shell_set.h"
#include "core/volume.h"
#include "reference/shell_picture.h"
#include "report/error_split.h"

namespace nacre {

/// The truth about a picture of shells, and the pictures between it and the shells.
struct ShellErrorChain {
  Image truth;                     ///< the exact picture of the volume
  std::vector<ErrorStage> stages;  ///< the last is the exact picture of the set's surfaces
};

/// Refuses a volume that a shell set was not made from.
/// @throws Error  BadArgument if dims, type or voxel checksum are not the set's
void check_same_volume(const Volume& volume, const VolumeFacts& facts);

/// The exact pictures that lie between a volume and a shell set made from it, each with one more
/// cause of error than the one before:
///
/// | picture | cause |
/// |---|---|
/// | of the volume itself (`truth`) | |
/// | of ideal shells: the volume's emission, constant between levels (max and sum only) | levels |
/// | of the levels' surfaces, extracted anew, by rays through their triangles | contouring |
/// | of these surfaces snapped to the set's grid | vertex quantisation |
/// | of the set's surfaces | simplification (and pruning) |
///
/// What a renderer adds to the last one is rasterisation, and the precision of its targets.
///
/// @param volume   what the set was made from: its samples are. Slope, intercept and place are
///                 taken from the set, which may have negated them (maps that fall)
/// @param set      decoded, with its grid
/// @param options  mode, cue, slab, hidden shells and tools, as for `shell_picture`
/// @throws Error   BadArgument if the set has no grid; as `check_same_volume`, `shell_picture`,
///                 `exact_picture` and `snap` do
///
/// Holds one set of surfaces at a time: the set's are freed before those of the volume are
/// extracted. The same for any number of threads.
ShellErrorChain shell_error_chain(Volume volume, ShellSet set, const Camera& camera,
                                  const ShellPictureOptions& options,
                                  const ProgressCallback& progress = {});

}  // namespace nacre

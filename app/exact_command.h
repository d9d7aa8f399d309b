#pragma once

#include "app/camera_flags.h"
#include "app/command.h"
#include "app/level_flags.h"
#include "app/picture_output.h"
#include "app/scene_flags.h"
#include "app/volume_flags.h"

namespace nacre {

/// All that an exact picture of a volume can be asked for.
struct ExactFlags {
  CommonFlags common;
  VolumeFlags volume;
  CameraFlags camera;
  PictureFlags picture;
  SceneFlags scene;
  LevelFlags levels;   ///< of count, iso and ideal shells
  bool ideal = false;  ///< ideal shells in place of the volume itself
  int samples = 0;     ///< a voxel, of a sampled maximum; 0: exact
};

/// Adds all but the flags of levels, which some verbs share with those of shells, and --ideal.
void add_exact_flags(CLI::App& verb, ExactFlags& flags);

/// Reads, walks, writes, and says what it took.
void run_exact(const ExactFlags& flags);

}  // namespace nacre

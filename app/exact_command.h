#pragma once

#include "app/camera_flags.h"
#include "app/command.h"
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
};

void add_exact_flags(CLI::App& verb, ExactFlags& flags);

/// Reads, walks, writes, and says what it took.
void run_exact(const ExactFlags& flags);

}  // namespace nacre

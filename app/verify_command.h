#pragma once

#include <string>

#include "app/command.h"
#include "app/volume_flags.h"

namespace nacre {

/// What to verify, and against what.
struct VerifyFlags {
  CommonFlags common;
  std::string file;
  VolumeFlags volume;  ///< its path is empty without --volume
};

/// Checks a file, and says what it found.
/// @return        1 if a promise is broken, else 0
/// @throws Error  BadFile if it cannot be read; Unsupported in a build without the shell tools
int run_verify(const VerifyFlags& flags);

}  // namespace nacre

#pragma once

#include <string>
#include <vector>

#include "core/picture.h"
#include "report/method.h"

namespace nacre {

/// What the commands of all rows have in common, as a shell reads it.
struct CommandTexts {
  std::string volume;  ///< the file, and the flags that say what its values mean
  std::string camera;  ///< flags of the views, --turntable among them
  std::string tools;   ///< --tool ...
  DepthCue cue = {};   ///< of the cued pictures
};

/// The commands that make a row's pictures anew, the exact ones, and their error.
std::vector<std::string> command_lines(const Method& method, const CommandTexts& texts);

}  // namespace nacre

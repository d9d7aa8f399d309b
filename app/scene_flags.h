#pragma once

#include <string>
#include <vector>

#include "core/picture.h"
#include "core/tool.h"

namespace CLI {
class App;
}

namespace nacre {

/// What a scene has beside its volume or shells, as flags say it.
struct SceneFlags {
  std::string cue;                 ///< "A,B,BETA0"; empty: none
  std::vector<std::string> tools;  ///< "FILE[,pose=FILE][,color=#rrggbb][,scale=S]"
};

/// Adds --cue and --tool.
void add_scene_flags(CLI::App& verb, SceneFlags& flags);

/// @throws Error  BadArgument unless it is three numbers whose beta(0) and beta(1) are not negative
DepthCue depth_cue(const SceneFlags& flags);

/// Reads the tools, in the order they were named. Those without a colour get one of seven that are
/// told apart also by the colour-blind, in turn.
///
/// A comma begins an option only where "pose=", "color=" or "scale=" follows: file names may hold
/// commas. Another "word=" after a comma is refused, not taken for a part of the name.
///
/// @throws Error  BadArgument for options that are wrong, BadFile for files that are
std::vector<Tool> read_tools(const SceneFlags& flags);

}  // namespace nacre

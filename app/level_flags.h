#pragma once

#include <string>
#include <vector>

#include "core/emission.h"
#include "extract/levels.h"

namespace CLI {
class App;
}

namespace nacre {

/// Which levels of a volume are shown as shells, as flags say it.
struct LevelFlags {
  std::string levels;        ///< a count, or emissions "t1,t2,..."; empty: the default
  std::string level_values;  ///< "v1,v2,..." in the volume's values
  std::string placement = "auto";
};

/// Adds --levels, --level-values and --placement.
void add_level_flags(CLI::App& verb, LevelFlags& flags);

/// Whether the flags name a number of levels, so that they are placed and not given.
bool are_placed(const LevelFlags& flags);

/// The levels, as emissions with their representatives.
///
/// @param otherwise  what --levels is where no flag says it
/// @throws Error     BadArgument for flags that name no levels
std::vector<Level> levels_of(const LevelFlags& flags, const EmissionMap& emission,
                             const std::string& otherwise = "24");

}  // namespace nacre

#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/command.h"
#include "app/level_flags.h"
#include "extract/emission_volume.h"

namespace nacre {

/// Levels, and how they were found: "uniform", "optimal" or "explicit".
struct PlacedLevels {
  std::vector<Level> levels;
  std::string placement;
};

/// The levels that flags ask for: listed ones with the means of the maximum projection's pixels as
/// representatives, a number of them evenly or where they err least, which is said.
///
/// @param figures  takes the predicted PSNRs where they were computed
/// @throws Error   as `levels_of`
PlacedLevels place_levels(const LevelFlags& flags, const EmissionVolume& input, Reporter& reporter,
                          nlohmann::ordered_json& figures);

}  // namespace nacre

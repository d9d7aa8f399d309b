#pragma once

#include <nlohmann/json.hpp>

#include "app/command.h"
#include "core/shell_set.h"
#include "shells/crossings.h"

namespace nacre {

/// What was pruned, said, and as a list of {"what", "why", ...}.
nlohmann::ordered_json tell_pruning(const Pruning& pruned, Reporter& reporter);

/// How neighbours meet, said, and as figures.
nlohmann::ordered_json tell_nesting(const std::vector<NeighbourCrossings>& crossings,
                                    Reporter& reporter);

}  // namespace nacre

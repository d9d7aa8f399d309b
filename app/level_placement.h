#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/command.h"
#include "app/level_flags.h"
#include "extract/emission_volume.h"
#include "shells/placement.h"

namespace nacre {

/// Levels, and how they were found: "uniform", "optimal" or "explicit".
struct PlacedLevels {
  std::vector<Level> levels;
  std::string placement;
};

/// Finds the levels that flags ask for: listed ones with the means of the maximum projection's
/// pixels as representatives, a number of them evenly or where they err least, which is said.
///
/// The projections' histogram is made when it is first needed, and serves every later request.
class LevelPlacer {
 public:
  /// @param input  must outlive this
  explicit LevelPlacer(const EmissionVolume& input) : input_(input) {}

  /// @param figures  takes the predicted PSNRs where they were computed
  /// @throws Error   as `levels_of`
  PlacedLevels place(const LevelFlags& flags, Reporter& reporter, nlohmann::ordered_json& figures);

 private:
  const MaximumHistogram& histogram(Reporter& reporter);

  const EmissionVolume& input_;
  std::optional<MaximumHistogram> histogram_;
};

}  // namespace nacre

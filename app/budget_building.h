#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "app/shell_building.h"

namespace nacre {

/// What `--budget` asks for, beside the flags of shells, which hold what they name.
struct BudgetFlags {
  std::string budget;  ///< see `parse_budget`
  /// Of the pictures that errors are measured with, pixels.
  glm::ivec2 picture_size{256, 256};
  bool is_certified = true;  ///< whether the file will hold a certificate, which counts, too
};

/// The best set within a budget: `trade` over `budget_ladder`, each set that fits measured as its
/// certificate will be, by exact maximum projections of its decoded shells. Each trial is a line of
/// what is said.
///
/// The volume stays in memory until the last trial.
///
/// @throws Error  BadArgument if the smallest set does not fit, or as `parse_budget`; Unsupported
/// in
///                a build without the shell tools
CompressedSet build_within_budget(const BudgetFlags& budget, const ShellFlags& flags,
                                  EmissionVolume input, const std::filesystem::path& scratch_folder,
                                  Reporter& reporter, BuildFigures& figures);

/// Checks the flag before the work.
/// @throws Error  as `parse_budget`
void check_budget(const std::string& budget);

}  // namespace nacre

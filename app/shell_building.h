#pragma once

#include <optional>
#include <string>

#include "app/command.h"
#include "app/volume_flags.h"
#include "core/shell_set.h"

namespace nacre {

/// Which shells to make of a volume, as flags say it.
struct ShellFlags {
  std::string levels = "24";  ///< a count, or emissions "t1,t2,..."
  std::string level_values;   ///< "v1,v2,..." in the volume's values
  std::string placement = "auto";
  double tolerance = 0.0;               ///< emission; 0: none
  double tolerance_mm = 0.0;            ///< mm; 0: none
  int quantization = 0;                 ///< bits; 0: chosen
  std::optional<double> min_component;  ///< mm^3; none: chosen
  bool keep_specks = false;
  std::string purpose = "all";  ///< all or max: which pictures the set must serve
};

/// Adds --levels, --level-values, --placement, --tolerance, --tolerance-mm, --quantization,
/// --min-component, --keep-specks and --purpose.
void add_shell_flags(CLI::App& verb, ShellFlags& flags);

/// What building took, in seconds, and how many triangles there were before simplification.
struct BuildFigures {
  double emission = 0.0;  ///< placing levels
  double extract = 0.0;
  double simplify = 0.0;  ///< and pruning and snapping
  double crossings = 0.0;
  std::size_t extracted_triangles = 0;
  nlohmann::ordered_json left_out = nlohmann::ordered_json::array();  ///< {"what", "why", ...} each
  nlohmann::ordered_json nesting;
  nlohmann::ordered_json placement;
};

/// Shells of a volume, in memory; the volume is gone afterwards.
/// @throws Error  BadArgument for flags that name no levels; Unsupported in a build without the
///                shell tools
ShellSet build_shell_set(const ShellFlags& flags, EmissionVolume input, Reporter& reporter,
                         BuildFigures& figures);

}  // namespace nacre

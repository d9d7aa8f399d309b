#include <CLI/CLI.hpp>

#include "app/shell_building.h"

namespace nacre {

void add_shell_flags(CLI::App& verb, ShellFlags& flags) {
  const std::string group = "Shells";
  auto* levels = verb.add_option("--levels", flags.levels,
                                 "N levels, or emissions t1,t2,... from above 0 to 1")
                     ->capture_default_str()
                     ->group(group);
  verb.add_option("--level-values", flags.level_values, "v1,v2,... in the volume's values")
      ->excludes(levels)
      ->group(group);
  verb.add_option("--placement", flags.placement, "Where N levels are put")
      ->check(CLI::IsMember({"uniform"}))
      ->capture_default_str()
      ->group(group);
  verb.add_option("--tolerance", flags.tolerance,
                  "Emission error a simplified surface may have (0: no simplification)")
      ->check(CLI::Range(0.0, 1.0))
      ->group(group);
  verb.add_option("--tolerance-mm", flags.tolerance_mm,
                  "MM a simplified surface may be off the extracted one (0: no simplification)")
      ->check(CLI::NonNegativeNumber)
      ->group(group);
  verb.add_option("--quantization", flags.quantization,
                  "Bits of a coordinate (default: the fewest from 12 whose step is 1/64 of the "
                  "smallest spacing)")
      ->check(CLI::Range(1, 30))
      ->group(group);
}

}  // namespace nacre

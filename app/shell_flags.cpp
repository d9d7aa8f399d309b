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
  verb.add_option("--placement", flags.placement,
                  "Where N levels are put: for the least error of maximum projections over "
                  "directions (optimal), evenly, or optimal where that gains more than 1 dB (auto)")
      ->check(CLI::IsMember({"auto", "optimal", "uniform"}))
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
  auto* least = verb.add_option("--min-component", flags.min_component,
                                "MM3: closed components of less volume are left out (default: a "
                                "quarter of a voxel)")
                    ->check(CLI::NonNegativeNumber)
                    ->group(group);
  verb.add_flag("--keep-specks", flags.keep_specks, "Leave out no component for its size")
      ->excludes(least)
      ->group(group);
  verb.add_option("--purpose", flags.purpose,
                  "max: cavities are left out, which no maximum projection shows that starts "
                  "outside the volume and has no slab; all: they stay, for sums and slabs, too")
      ->check(CLI::IsMember({"all", "max"}))
      ->capture_default_str()
      ->group(group);
}

}  // namespace nacre

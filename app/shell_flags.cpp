#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>

#include "app/shell_building.h"
#include "core/error.h"

namespace nacre {
namespace {

/// CLI11's own ranges let NaN through and spell out the largest double.
CLI::Validator finite_from_zero(double most, const char* expected) {
  return {[most, expected](const std::string& text) {
            double number = std::numeric_limits<double>::quiet_NaN();
            const bool is_number = CLI::detail::lexical_cast(text, number);
            const bool is_good = is_number && number >= 0.0 && number <= most;
            return is_good ? std::string() : fmt::format("found {}, expected {}", text, expected);
          },
          "FLOAT"};
}

constexpr const char* kGroup = "Shells";

}  // namespace

void check_tolerance_weight(const ShellFlags& flags) {
  if (flags.tolerance_weight.empty() || flags.tolerance.value_or(0.0) > 0.0) return;
  throw Error(ErrorCode::BadArgument,
              fmt::format("--tolerance-weight: found {} and no --tolerance, expected both, or a "
                          "--budget",
                          flags.tolerance_weight));
}

double named_copies_tolerance(const ShellFlags& flags) {
  if (flags.coarse == kAutoCopies || flags.coarse == kNoCopies) return 0.0;
  const double own = flags.tolerance.value_or(0.0);
  double named = 0.0;
  if (!CLI::detail::lexical_cast(flags.coarse, named) || !(named > own && named <= 1.0)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("--coarse: found {}, expected auto, none, or an emission above "
                            "--tolerance ({}) and up to 1",
                            flags.coarse, own));
  }
  if (!(own > 0.0)) {
    throw Error(ErrorCode::BadArgument,
                "--coarse: found shells that are not simplified, expected --tolerance");
  }
  return named;
}

void add_shell_flags(CLI::App& verb, ShellFlags& flags) {
  add_level_flags(verb, flags);
  verb.add_option("--tolerance", flags.tolerance,
                  "Emission error a simplified surface may have (0: no simplification)")
      ->check(finite_from_zero(1.0, "an emission from 0 to 1"))
      ->group(kGroup);
  verb.add_option(
          "--tolerance-weight", flags.tolerance_weight,
          "Where --tolerance may be used up. field: everywhere; picture: where the field is "
          "steep, 1/3 of it at a shell's mean slope, down to 1/9 where maximum projections "
          "show more of an error (default: field, and picture for a --budget that chooses "
          "the tolerance)")
      ->check(CLI::IsMember({kFieldWeight, kPictureWeight}))
      ->group(kGroup);
  verb.add_option("--tolerance-mm", flags.tolerance_mm,
                  "MM a simplified surface may be off the extracted one (0: no simplification)")
      ->check(finite_from_zero(std::numeric_limits<double>::max(), "millimetres, 0 or more"))
      ->group(kGroup);
  verb.add_option("--quantization", flags.quantization,
                  "Bits of a coordinate (default: the fewest from 12 whose step is 1/64 of the "
                  "smallest spacing)")
      ->check(CLI::Range(1, 30))
      ->group(kGroup);
  auto* least = verb.add_option("--min-component", flags.min_component,
                                "MM3: closed components of less volume are left out (default: "
                                "1/64 of a voxel)")
                    ->check(finite_from_zero(1e30, "a volume in mm3"))
                    ->group(kGroup);
  verb.add_flag("--keep-specks", flags.keep_specks, "Leave out no component for its size")
      ->excludes(least)
      ->group(kGroup);
  verb.add_option("--purpose", flags.purpose,
                  "max: cavities are left out, which no maximum projection shows that starts "
                  "outside the volume and has no slab; all: they stay, for sums and slabs, too")
      ->check(CLI::IsMember({"all", "max"}))
      ->capture_default_str()
      ->group(kGroup);
}

void add_compression_flag(CLI::App& verb, ShellFlags& flags) {
  verb.add_option(
          "--compression", flags.compression,
          "Draco's effort, from 0 (soonest written and read) to 10 (smallest); default: 10, "
          "8 for surfaces that are not simplified")
      ->check(CLI::Range(0, kMostEffort))
      ->group(kGroup);
}

}  // namespace nacre

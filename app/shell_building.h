#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/command.h"
#include "app/level_flags.h"
#include "app/volume_flags.h"
#include "core/shell_set.h"
#include "io/shell_writer.h"

namespace nacre {

/// Values of --coarse beside a number.
inline constexpr const char* kAutoCopies = "auto";
inline constexpr const char* kNoCopies = "none";

/// Values of --tolerance-weight.
inline constexpr const char* kFieldWeight = name(ToleranceWeight::Field);
inline constexpr const char* kPictureWeight = name(ToleranceWeight::Picture);

/// Which shells to make of a volume, as flags say it.
struct ShellFlags : LevelFlags {
  std::optional<double> tolerance;      ///< emission; 0 or none: no simplification
  std::string tolerance_weight;         ///< field or picture; empty: chosen
  double tolerance_mm = 0.0;            ///< mm; 0: none
  int quantization = 0;                 ///< bits; 0: chosen
  std::optional<int> compression;       ///< Draco's effort; none: chosen
  std::optional<double> min_component;  ///< mm^3; none: chosen
  bool keep_specks = false;
  std::string purpose = "all";     ///< all or max: which pictures the set must serve
  std::string coarse = kNoCopies;  ///< auto, none, or the emission error of coarse copies
};

/// Adds the flags of levels, --tolerance, --tolerance-weight, --tolerance-mm, --quantization,
/// --min-component, --keep-specks and --purpose.
void add_shell_flags(CLI::App& verb, ShellFlags& flags);

/// Adds --compression, for what writes a set.
void add_compression_flag(CLI::App& verb, ShellFlags& flags);

/// @throws Error  BadArgument for a --tolerance-weight of no tolerance
void check_tolerance_weight(const ShellFlags& flags);

/// The emission error that --coarse names; 0 for auto and none.
/// @throws Error  BadArgument if it is out of range, or shells are not simplified
double named_copies_tolerance(const ShellFlags& flags);

/// What building took, in seconds, and how many triangles there were before simplification.
struct BuildFigures {
  double emission = 0.0;  ///< placing levels
  double extract = 0.0;
  double simplify = 0.0;
  double coarsen = 0.0;
  double encode = 0.0;
  double crossings = 0.0;
  double certificate = 0.0;
  double trade = 0.0;  ///< trying sets for a budget, the chosen one's building included
  std::size_t extracted_triangles = 0;
  nlohmann::ordered_json left_out = nlohmann::ordered_json::array();  ///< {"what", "why", ...} each
  nlohmann::ordered_json nesting;
  nlohmann::ordered_json placement;
  /// Of coarse copies, `max` and `sum`; empty where it was not measured.
  nlohmann::ordered_json coarse_error = nlohmann::ordered_json::object();
  nlohmann::ordered_json budget;  ///< what was tried, where there is one
};

/// Shells of a volume, in memory; the volume is gone afterwards.
/// @throws Error  BadArgument for flags that name no levels; Unsupported in a build without the
///                shell tools
ShellSet build_shell_set(const ShellFlags& flags, EmissionVolume input, Reporter& reporter,
                         BuildFigures& figures);

/// A set whose surfaces are compressed already.
struct CompressedSet {
  ShellSet set;  ///< without surfaces
  std::vector<CompressedShell> shells;
  std::optional<CoarseShells> coarse = {};
};

/// The same, each shell compressed when it is finished: never all of them in memory at once.
/// @param scratch_folder  where surfaces wait for their turn, see `BuildOptions`
CompressedSet build_compressed_set(const ShellFlags& flags, EmissionVolume input,
                                   const std::filesystem::path& scratch_folder, Reporter& reporter,
                                   BuildFigures& figures);

/// The shell of one more level of a volume that stays: a set of one, as fast as it can be had, for
/// a page (`pack_shell`).
///
/// What needs looks at the whole set or along rays is left out: the representative is 1, whatever
/// maxima through the layer would make of it, and no crossings are counted.
///
/// @param emission  in (0, 1]
/// @throws Error    as `build_shells`
CompressedSet build_one_level(const ShellFlags& flags, const EmissionVolume& input,
                              double emission);

/// Whether the flags ask for surfaces to be simplified, which takes many times as long as making
/// them.
bool is_simplifying(const ShellFlags& flags);

}  // namespace nacre

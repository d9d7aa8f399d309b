#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/shell_set.h"
#include "shells/verify.h"

namespace nacre {

/// What was found out of surfaces, one a shell.
struct SurfaceFindings {
  ShellSet set;
  std::string kind = "shell";      ///< what each is, for words: with its name "shell 3", "copy 3"
  std::vector<std::string> names;  ///< of the shells, for words
  std::vector<ShellVerdict> surfaces;
  std::vector<VolumeVerdict> against_volume;  ///< empty without a volume
};

/// All that was found out of a file's surfaces.
struct VerifyFindings : SurfaceFindings {
  /// The shells' coarse copies, empty where there is none; its set has their tolerance.
  std::optional<SurfaceFindings> copies;
  std::vector<std::string> broken;  ///< promises, one line each
  std::vector<std::string> warnings;
};

/// Whether neighbours cannot cross: the bounds of their emissions are disjoint.
bool crossing_is_impossible(const SurfaceFindings& findings, std::size_t shell);

/// A table, line by line.
std::vector<std::string> verify_table(const VerifyFindings& findings);

nlohmann::ordered_json verify_json(const VerifyFindings& findings);

}  // namespace nacre

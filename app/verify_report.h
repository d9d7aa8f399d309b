#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/shell_set.h"
#include "shells/verify.h"

namespace nacre {

/// All that was found out of a file's surfaces.
struct VerifyFindings {
  ShellSet set;
  std::vector<std::string> names;  ///< of the shells, for words
  std::vector<ShellVerdict> surfaces;
  std::vector<VolumeVerdict> against_volume;  ///< empty without a volume
  std::vector<std::string> broken;            ///< promises, one line each
  std::vector<std::string> warnings;
};

/// Whether neighbours cannot cross: the bounds of their emissions are disjoint.
bool crossing_is_impossible(const VerifyFindings& findings, std::size_t shell);

/// A table, line by line.
std::vector<std::string> verify_table(const VerifyFindings& findings);

nlohmann::ordered_json verify_json(const VerifyFindings& findings);

}  // namespace nacre

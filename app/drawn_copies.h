#pragma once

#include <string>

#include "app/command.h"
#include "io/shell_reader.h"

namespace nacre {

/// What is drawn of a file with --coarse: its copies, and the shells that have none.
struct DrawnCopies {
  std::size_t copies = 0;
  std::size_t shells = 0;  ///< not empty, drawn themselves: they have no copy
  double tolerance = 0.0;  ///< emission error that the copies' simplification was allowed
  std::string error_json;  ///< of the maxima of the copies; empty if the file does not state it
};

/// Puts the copies' figures in place of those of their shells.
/// @throws Error  BadArgument if the file has no copy: "PATH: found ..., expected ..."
DrawnCopies take_copies(const std::string& path, ShellFileInfo& info);

/// Says what is drawn: a part of --explain.
void say_copies(const DrawnCopies& drawn, Reporter& reporter);

/// The same for --json; the error is null where the file does not state it.
nlohmann::ordered_json copies_json(const DrawnCopies& drawn);

}  // namespace nacre

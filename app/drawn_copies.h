#pragma once

#include <string>

#include "app/command.h"
#include "core/picture.h"
#include "io/shell_reader.h"
#include "render/render_options.h"

namespace nacre {

/// What is drawn of a file with --coarse: its copies, and the shells that have none.
struct DrawnCopies {
  std::size_t copies = 0;
  std::size_t shells = 0;      ///< not empty, drawn themselves: they have no copy
  double tolerance = 0.0;      ///< emission error that the copies' simplification was allowed
  std::string max_error_json;  ///< of maxima of the copies; empty if the file does not state it
  std::string max_fine_error_json;  ///< of maxima estimated between the levels, likewise
  std::string sum_error_json;       ///< of their sums, likewise
};

/// Puts the copies' figures in place of those of their shells.
/// @throws Error  BadArgument if the file has no copy: "PATH: found ..., expected ..."
DrawnCopies take_copies(const std::string& path, ShellFileInfo& info);

/// Says what is drawn, and the error that the file states of such pictures: a part of --explain.
/// @param layers  what maxima show between the levels
void say_copies(const DrawnCopies& drawn, PictureMode mode, Layers layers, Reporter& reporter);

/// The same for --json: the error of maxima as `max` or `max_fine`, of sums as `sum`, null where
/// the file does not state it; none in other modes, of which nothing is measured.
nlohmann::ordered_json copies_json(const DrawnCopies& drawn, PictureMode mode, Layers layers);

}  // namespace nacre

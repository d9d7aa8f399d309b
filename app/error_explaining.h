#pragma once

#include <optional>
#include <string>

#include "app/exact_command.h"
#include "app/shell_render.h"
#include "core/picture.h"
#include "report/error_split.h"

namespace nacre {

/// What `nacre compare --explain-error` is told.
struct ExplainFlags {
  std::string set;   ///< shell set file; empty: nothing is to be explained
  ExactFlags scene;  ///< volume, camera, mode, cue, tools and slab
  DrawFlags draw;
};

/// Adds --explain-error, --volume, and what says how the picture was made; these need
/// --explain-error.
void add_explain_flags(CLI::App& verb, ExplainFlags& flags);

/// A picture of a shell set, the truth about it, and where they part.
struct ExplainedError {
  Image picture;
  Image truth;
  PictureMode mode = PictureMode::Max;
  ErrorSplit split;
};

/// Draws the set (unless `picture` is what was drawn), and makes the exact pictures between it and
/// the volume.
///
/// @throws Error  BadArgument if the volume is not the set's, or the picture of another mode or
///                size; Unsupported in builds without the shell tools
ExplainedError explain_error(const ExplainFlags& flags, std::optional<Image> picture,
                             Reporter& reporter);

}  // namespace nacre

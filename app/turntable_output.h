#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "app/picture_output.h"
#include "core/image.h"
#include "render/display.h"

namespace nacre {

/// What is to be drawn and kept in writing the views of a turntable, or a single picture.
struct TurntableOptions {
  int views = 1;
  bool tools = false;  ///< whether the scene has tools: then all views of a turntable are RGB
  std::size_t most_kept_bytes = std::size_t{1}
                                << 30;  ///< of measured pictures, until all are drawn
};

/// What came of it.
struct TurntableResult {
  Picture last;                         ///< the last view
  std::optional<DisplayWindow> window;  ///< that all views were displayed with, if any was
  double write_seconds = 0.0;           ///< without the drawing
};

/// Draws views 0, 1, ... and writes them where the flags say: as numbered PNGs or TIFFs, as one
/// animated PNG of 6 seconds a turn, or, without an output, nowhere (for timing).
///
/// All views are displayed with one brightness window: --display, or the mode's usual one, which
/// for sums goes up to the largest pixel of all views. Then the measured pictures are kept until
/// all are drawn; where they take too much memory, each view is drawn twice.
///
/// Files appear under their names when all of them are written; after an error nothing is left
/// behind.
///
/// @param draw    gives a view by its number; called once a view, or twice, in order
/// @throws Error  what `draw` throws; BadArgument for names that cannot be written to
TurntableResult write_views(const PictureFlags& flags, const TurntableOptions& options,
                            const std::function<Picture(int view)>& draw);

}  // namespace nacre

#pragma once

#include <algorithm>
#include <limits>

#include "core/camera.h"
#include "core/picture.h"
#include "reference/pixel_range.h"
#include "reference/tile_rays.h"
#include "reference/tool_rays.h"

namespace nacre {

/// Calls `on_line(x, y, line)` for each of some pixels whose ray may pass the volume in front of
/// the nearest tool, with the part of it that is visible. Tools are put into the picture on the
/// way.
///
/// @param tools  those of the picture's layer; null if it has none
template <class OnLine>
void for_visible_lines(const PixelLines& lines, const Camera& camera, const DepthCue& cue,
                       const ToolRays* tools, const PixelRange& pixels, Picture& picture,
                       const OnLine& on_line) {
  PixelLine line;
  for (int y = pixels.first.y; y <= pixels.last.y; ++y) {
    for (int x = pixels.first.x; x <= pixels.last.x; ++x) {
      double t_tool = std::numeric_limits<double>::infinity();
      if (picture.tools) {
        const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
        t_tool = draw_tool_pixel(*tools, camera, cue, ray, x, y, *picture.tools);
      }
      if (!lines.find(x, y, line)) continue;
      line.visible.t_exit = std::min(line.visible.t_exit, t_tool - line.t_shift_mm);
      if (line.visible.t_enter < line.visible.t_exit) on_line(x, y, line);
    }
  }
}

}  // namespace nacre

#pragma once

#include <optional>

#include "render/gl/frame_program.h"
#include "render/gl/tool_buffers.h"
#include "render/plan.h"

namespace nacre {

/// Draws the tool layer: for each pixel the nearest tool's colour under a headlight, on both sides
/// of its flat triangles, times the cue, and its depth beyond the start of the rays in the fourth
/// channel.
class ToolPass {
 public:
  explicit ToolPass(const GlFunctions& gl) : gl_(&gl) {}

  /// @param depths_mm  beyond the start of the rays, of all tools
  /// @throws Error     Unsupported if the driver refuses the program
  void draw(const Pass& pass, const Interval& depths_mm, const ToolBuffers& tools,
            const TileFrame& tile);

 private:
  /// The program and where its own uniforms are.
  struct Program {
    FrameProgram program;
    int depths;
    int color;
  };

  const GlFunctions* gl_;
  std::optional<Program> program_;  // made when first needed
};

}  // namespace nacre

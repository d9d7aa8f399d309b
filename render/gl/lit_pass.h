#pragma once

#include <map>

#include "render/gl/frame_program.h"
#include "render/gl/shell_buffers.h"
#include "render/plan.h"

namespace nacre {

/// Draws lit shells, the nearest crossing of each ray winning: `headlight` of the cosine between
/// the smooth normal and the way to the eye, times the cue.
class LitPass {
 public:
  explicit LitPass(const GlFunctions& gl) : gl_(&gl) {}

  /// @pre           the shells have normals
  /// @throws Error  Unsupported if the driver refuses a program
  void draw(const Pass& pass, const Interval& depths_mm, const ShellBuffers& shells,
            const TileFrame& tile);

 private:
  struct Work {
    bool cut = false;  ///< by slab or tools
    bool compare_tools = false;

    auto operator<=>(const Work&) const = default;
  };

  struct Program {
    FrameProgram program;
    int depths;
  };

  const Program& program(const Work& work);

  const GlFunctions* gl_;
  std::map<Work, Program> programs_;  // made when first needed
};

}  // namespace nacre

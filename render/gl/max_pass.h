#pragma once

#include <map>

#include "render/gl/frame_program.h"
#include "render/gl/shell_buffers.h"
#include "render/gl/tool_buffers.h"
#include "render/plan.h"

namespace nacre {

/// Draws shells into a depth buffer under each shell's depth remap, the greatest depth winning
/// ([H96] eqs 3 to 5), and the tools under the same remap before a shell they may hide (section 4).
///
/// The remap is the depth range: the viewport's affine map of depth after projection, clipping and
/// division, depth_at_near for -1 and depth_at_far for 1. What the matrix form of [H96] has to keep
/// in place (x, y, w, the near plane) is not touched, and a constant rank is written exactly: the
/// map's slope is 0. In perspective depth after division is no linear function of eye depth, so a
/// remap that is no constant is written per fragment.
class MaxPass {
 public:
  explicit MaxPass(const GlFunctions& gl) : gl_(&gl) {}

  /// @param tools   what the pass's tools are drawn from; may be null where it has none
  /// @throws Error  Unsupported if the driver refuses a program
  void draw(const Pass& pass, const ShellBuffers& shells, const ToolBuffers* tools,
            const TileFrame& tile);

 private:
  /// What a fragment has to do besides leaving its depth to the hardware.
  struct Work {
    bool cut_by_slab = false;
    bool compare_tools = false;
    bool write_depth = false;
    bool write_color = false;

    auto operator<=>(const Work&) const = default;
  };

  /// A program and where its own uniforms are.
  struct Program {
    FrameProgram program;
    int remap;
    int values;
  };

  static Work work_for(const Pass& pass, const ShellDraw& draw, bool perspective);
  const Program& program(const Work& work);
  void use(const Work& work, const ShellDraw& draw, const TileFrame& tile);
  void draw_tools(const Pass& pass, const ShellDraw& draw, const ToolBuffers& tools,
                  const TileFrame& tile);

  const GlFunctions* gl_;
  std::map<Work, Program> programs_;  // made when first needed
  const Program* used_ = nullptr;
};

}  // namespace nacre

#pragma once

#include <map>
#include <utility>

#include "render/gl/frame_program.h"
#include "render/gl/shell_buffers.h"
#include "render/plan.h"

namespace nacre {

/// Adds up what the crossings of each ray contribute, in any order, in a colour target without
/// depth.
///
/// - Sum: (r_k - r_previous) s B(d), s = +1 leaving and -1 entering a shell, B the antiderivative
/// of
///   the cue along the ray, 0 at its start (see `RayFrame`), d clamped to start and end. A crossing
///   before the start adds nothing, one beyond the end ends the emission there.
/// - Count: r_k, where d is between start and end.
/// - StartCounts, EndCounts: s where d is beyond the start (end): in all, the number of closed
///   shells that contain it.
class CrossingsPass {
 public:
  explicit CrossingsPass(const GlFunctions& gl) : gl_(&gl) {}

  /// @throws Error  Unsupported if the driver refuses a program
  void draw(const Pass& pass, const ShellBuffers& shells, const TileFrame& tile);

 private:
  /// A program and where its own uniform is.
  struct Program {
    FrameProgram program;
    int weight;
  };

  const Program& program(PassKind kind, bool compare_tools);

  const GlFunctions* gl_;
  std::map<std::pair<PassKind, bool>, Program> programs_;  // made when first needed
};

}  // namespace nacre

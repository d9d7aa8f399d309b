#pragma once

#include <glm/mat4x4.hpp>

#include "render/gl/gl_objects.h"
#include "render/gl/shell_buffers.h"
#include "render/plan.h"

namespace nacre {

/// Draws shells into a depth buffer under each shell's depth remap, the greatest depth winning
/// ([H96] eqs 3 to 5).
///
/// The remap is the depth range: the viewport's affine map of depth after projection, clipping and
/// division, depth_at_near for -1 and depth_at_far for 1. What the matrix form of [H96] has to keep
/// in place (x, y, w, the near plane) is not touched, and a constant rank is written exactly: the
/// map's slope is 0.
class MaxPass {
 public:
  /// @throws Error  Unsupported if the driver refuses the program
  explicit MaxPass(const GlFunctions& gl);

  /// @param clip_from_local  as `nacre::clip_from_local` gives it, rounded
  /// @param perspective      whether the matrix is a perspective one, with a near plane
  void draw(const Pass& pass, const ShellBuffers& shells, const glm::mat4& clip_from_local,
            bool perspective) const;

 private:
  void set_faces(Faces faces) const;

  const GlFunctions* gl_;
  GlProgram program_;
  int clip_from_local_ = -1;
};

}  // namespace nacre

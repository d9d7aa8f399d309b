#pragma once

#include <glm/mat4x4.hpp>
#include <string>
#include <string_view>

#include "render/gl/gl_objects.h"
#include "render/plan.h"
#include "render/ray_frame.h"

namespace nacre {

/// What drawing a part of a picture needs besides the meshes.
struct TileFrame {
  glm::mat4 clip_from_local{1.0F};
  RayFrame rays;
  bool perspective = false;
  unsigned tool_layer = 0;  ///< texture of the nearest tool's colour and, in its fourth channel,
                            ///< depth beyond the start of the rays; 0 where there is none
};

/// A program whose fragments know their place on the ray: the one mechanism by which slabs and
/// tools cut rays, in all pictures.
///
/// The fragment source may use, besides what it declares itself:
///
///     float depth_mm            beyond the start of the ray, along the viewing direction
///     float ray_end_mm()        where the ray ends: slab or, with TOOLS defined, the nearest tool;
///                               negative for a tool before the start: nothing shows
///     bool  outside_ray()       before the start or beyond the end
///     float depth_z()           the design's depth z, in [0, 1]
///     float cue_at_depth()      beta(z)
///     vec3  ray_way()           to the right, upwards, 1 forward (see `RayFrame`)
///     float cue_integral(d)     antiderivative of beta along the ray at depth d, mm
///     vec3  surface_normal      with NORMALS defined as `smooth` or `flat`
///     vec3  local_way()         ray_way() in the frame of positions and normals
class FrameProgram {
 public:
  /// @param defines  lines of "#define ..."
  /// @throws Error   Unsupported if the driver refuses it
  FrameProgram(const GlFunctions& gl, std::string_view fragment_source,
               const std::string& defines = "");

  /// Makes it the program to draw with, for fragments of that part of the picture.
  void use(const TileFrame& tile) const;

  /// Of the fragment source's own uniforms; -1 for one that has no effect.
  int uniform(const char* name) const;

 private:
  const GlFunctions* gl_;
  GlProgram program_;
  int clip_from_local_;
  int depth_from_local_;
  int end_mm_;
  int z_of_depth_;
  int cue_;
  int cue_range_;
  int slope_of_pixel_;
  int local_from_view_;
  int tool_layer_;
};

/// Culls the other walls of what is drawn next.
void set_faces(const GlFunctions& gl, Faces faces);

/// Whether what is before a perspective eye's near plane is clipped; nothing is behind an
/// orthographic eye, which is infinitely far.
void set_near_plane(const GlFunctions& gl, bool clips);

}  // namespace nacre

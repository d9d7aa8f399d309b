#include "render/gl/frame_program.h"

#include <GL/glcorearb.h>

#include <glm/gtc/type_ptr.hpp>

#include "render/ray_ends.h"

namespace nacre {
namespace {

constexpr const char* kVersion = "#version 330 core\n";

constexpr const char* kVertexSource = R"(
layout(location = 0) in vec3 position_mm;
uniform mat4 clip_from_local;
uniform vec4 depth_from_local;
out float depth_mm;
invariant gl_Position;
#ifdef NORMALS
layout(location = 1) in vec3 normal;
NORMALS out vec3 surface_normal;
#endif

void main() {
  gl_Position = clip_from_local * vec4(position_mm, 1.0);
  depth_mm = dot(depth_from_local, vec4(position_mm, 1.0));
#ifdef NORMALS
  surface_normal = normal;
#endif
}
)";

constexpr const char* kFragmentPrelude = R"(
in float depth_mm;
uniform float end_mm;
uniform vec2 z_of_depth;
uniform vec2 cue;
uniform vec2 cue_range;
uniform vec4 slope_of_pixel;
uniform mat3 local_from_view;
#ifdef TOOLS
uniform sampler2D tool_layer;
#endif
#ifdef NORMALS
NORMALS in vec3 surface_normal;
#endif

float ray_end_mm() {
#ifdef TOOLS
  float tool_mm = texelFetch(tool_layer, ivec2(gl_FragCoord.xy), 0).a;
  return min(end_mm, tool_mm);
#else
  return end_mm;
#endif
}

bool outside_ray() { return depth_mm < 0.0 || depth_mm > ray_end_mm(); }

float depth_z() { return clamp(z_of_depth.x + z_of_depth.y * depth_mm, 0.0, 1.0); }

float cue_at_depth() { return clamp(cue.x + cue.y * depth_mm, cue_range.x, cue_range.y); }

vec3 ray_way() { return vec3(slope_of_pixel.xy + slope_of_pixel.zw * gl_FragCoord.xy, 1.0); }

vec3 local_way() { return local_from_view * ray_way(); }

float cue_integral(float d) { return length(ray_way()) * d * (cue.x + 0.5 * cue.y * d); }
)";

}  // namespace

FrameProgram::FrameProgram(const GlFunctions& gl, std::string_view fragment_source,
                           const std::string& defines)
    : gl_(&gl),
      program_(make_program(
          gl, (kVersion + defines + kVertexSource).c_str(),
          (kVersion + defines + kFragmentPrelude + std::string(fragment_source)).c_str())),
      clip_from_local_(uniform("clip_from_local")),
      depth_from_local_(uniform("depth_from_local")),
      end_mm_(uniform("end_mm")),
      z_of_depth_(uniform("z_of_depth")),
      cue_(uniform("cue")),
      cue_range_(uniform("cue_range")),
      slope_of_pixel_(uniform("slope_of_pixel")),
      local_from_view_(uniform("local_from_view")),
      tool_layer_(uniform("tool_layer")) {}

int FrameProgram::uniform(const char* name) const {
  return gl_->get_uniform_location(program_.id(), name);
}

// A uniform without effect in the program is at -1, where setting it does nothing.
void FrameProgram::use(const TileFrame& tile) const {
  const RayFrame& rays = tile.rays;
  gl_->use_program(program_.id());
  gl_->uniform_matrix_4fv(clip_from_local_, 1, GL_FALSE, glm::value_ptr(tile.clip_from_local));
  gl_->uniform_4fv(depth_from_local_, 1, glm::value_ptr(glm::vec4(rays.depth_from_local)));
  gl_->uniform_1f(end_mm_, finite_mm(rays.end_mm));
  gl_->uniform_2fv(z_of_depth_, 1, glm::value_ptr(glm::vec2(rays.z_of_depth)));
  gl_->uniform_2fv(cue_, 1, glm::value_ptr(glm::vec2(rays.cue)));
  gl_->uniform_2fv(cue_range_, 1, glm::value_ptr(glm::vec2(rays.cue_range)));
  gl_->uniform_4fv(slope_of_pixel_, 1, glm::value_ptr(glm::vec4(rays.slope_of_pixel)));
  gl_->uniform_matrix_3fv(local_from_view_, 1, GL_FALSE,
                          glm::value_ptr(glm::mat3(rays.local_from_view)));
  gl_->uniform_1i(tool_layer_, 0);
  if (tool_layer_ >= 0) {
    gl_->active_texture(GL_TEXTURE0);
    gl_->bind_texture(GL_TEXTURE_2D, tile.tool_layer);
  }
}

void set_faces(const GlFunctions& gl, Faces faces) {
  gl.front_face(GL_CW);  // y points down in clip coordinates
  if (faces == Faces::Both) {
    gl.disable(GL_CULL_FACE);
    return;
  }
  gl.enable(GL_CULL_FACE);
  gl.cull_face(faces == Faces::Front ? GL_BACK : GL_FRONT);
}

void set_near_plane(const GlFunctions& gl, bool clips) {
  clips ? gl.disable(GL_DEPTH_CLAMP) : gl.enable(GL_DEPTH_CLAMP);
}

}  // namespace nacre

#include "render/gl/tool_pass.h"

#include <GL/glcorearb.h>

#include <array>
#include <glm/gtc/type_ptr.hpp>

#include "render/gl/headlight_source.h"

namespace nacre {
namespace {

// A triangle without area has no normal: it is then lit from everywhere only.
constexpr const char* kFragmentSource = R"(
uniform vec3 color;
out vec4 seen;

void main() {
  float cosine = abs(dot(surface_normal, normalize(local_way())));
  seen = vec4(color * (headlight(cosine) * cue_at_depth()), depth_mm);
  gl_FragDepth = linear_depth();
}
)";

}  // namespace

void ToolPass::draw(const Pass& pass, const Interval& depths_mm, const ToolBuffers& tools,
                    const TileFrame& tile) {
  if (!program_) {
    FrameProgram made(*gl_, headlight_source() + kFragmentSource, "#define NORMALS flat\n");
    const int depths = made.uniform("depths_mm");
    const int color = made.uniform("color");
    program_.emplace(Program{std::move(made), depths, color});
  }
  gl_->disable(GL_BLEND);
  gl_->enable(GL_DEPTH_TEST);
  gl_->depth_func(GL_LESS);
  gl_->depth_range(0.0, 1.0);
  set_near_plane(*gl_, tile.perspective);
  set_faces(*gl_, Faces::Both);
  program_->program.use(tile);
  const std::array<float, 2> depths{static_cast<float>(depths_mm.lo),
                                    static_cast<float>(depths_mm.hi)};
  gl_->uniform_2fv(program_->depths, 1, depths.data());
  tools.bind();
  for (const std::uint32_t tool : pass.tools) {
    gl_->uniform_3fv(program_->color, 1, glm::value_ptr(tools.color(tool)));
    tools.draw(tool);
  }
}

}  // namespace nacre

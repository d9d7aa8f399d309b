#include "render/gl/crossings_pass.h"

#include <GL/glcorearb.h>

#include <string>

namespace nacre {
namespace {

constexpr const char* kFragmentSource = R"(
uniform float weight;
out float added;

void main() {
  float leaving = gl_FrontFacing ? -1.0 : 1.0;
#if defined(SUM)
  added = weight * leaving * cue_integral(clamp(depth_mm, 0.0, max(ray_end_mm(), 0.0)));
#elif defined(COUNT)
  if (outside_ray()) discard;
  added = weight;
#elif defined(AT_START)
  added = depth_mm > 0.0 ? leaving : 0.0;
#else
  added = depth_mm > ray_end_mm() ? leaving : 0.0;
#endif
}
)";

std::string define_of(PassKind kind) {
  switch (kind) {
    case PassKind::Sum: return "#define SUM\n";
    case PassKind::Count: return "#define COUNT\n";
    case PassKind::StartCounts: return "#define AT_START\n";
    default: return "";
  }
}

}  // namespace

const CrossingsPass::Program& CrossingsPass::program(PassKind kind, bool compare_tools) {
  const auto found = programs_.find({kind, compare_tools});
  if (found != programs_.end()) return found->second;
  FrameProgram made(*gl_, kFragmentSource,
                    define_of(kind) + (compare_tools ? "#define TOOLS\n" : ""));
  const int weight = made.uniform("weight");
  return programs_.emplace(std::pair(kind, compare_tools), Program{std::move(made), weight})
      .first->second;
}

void CrossingsPass::draw(const Pass& pass, const ShellBuffers& shells, const TileFrame& tile) {
  gl_->disable(GL_DEPTH_TEST);
  gl_->enable(GL_BLEND);
  gl_->blend_func(GL_ONE, GL_ONE);
  gl_->depth_range(0.0, 1.0);
  set_near_plane(*gl_, tile.perspective);
  shells.bind();
  const Program* used = nullptr;
  for (const ShellDraw& draw : pass.draws) {
    const Program& wanted = program(pass.kind, draw.tools == ToolCut::Texture);
    if (used != &wanted) wanted.program.use(tile);
    used = &wanted;
    gl_->uniform_1f(wanted.weight, static_cast<float>(draw.weight));
    set_faces(*gl_, draw.faces);
    shells.draw(draw.shell);
  }
  gl_->disable(GL_BLEND);
}

}  // namespace nacre

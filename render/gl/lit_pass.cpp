#include "render/gl/lit_pass.h"

#include <GL/glcorearb.h>

#include <array>
#include <string>

#include "render/gl/headlight_source.h"

namespace nacre {
namespace {

constexpr const char* kFragmentSource = R"(
out float brightness;

void main() {
#ifdef CUT
  if (outside_ray()) discard;
#endif
  float cosine = -dot(normalize(surface_normal), normalize(local_way()));
  brightness = headlight(cosine) * cue_at_depth();
  gl_FragDepth = linear_depth();
}
)";

}  // namespace

const LitPass::Program& LitPass::program(const Work& work) {
  const auto found = programs_.find(work);
  if (found != programs_.end()) return found->second;
  std::string defines = "#define NORMALS smooth\n";
  if (work.cut) defines += "#define CUT\n";
  if (work.compare_tools) defines += "#define TOOLS\n";
  FrameProgram made(*gl_, headlight_source() + kFragmentSource, defines);
  const int depths = made.uniform("depths_mm");
  return programs_.emplace(work, Program{std::move(made), depths}).first->second;
}

void LitPass::draw(const Pass& pass, const Interval& depths_mm, const ShellBuffers& shells,
                   const TileFrame& tile) {
  gl_->disable(GL_BLEND);
  gl_->enable(GL_DEPTH_TEST);
  gl_->depth_func(GL_LESS);
  gl_->depth_range(0.0, 1.0);
  set_near_plane(*gl_, tile.perspective);
  shells.bind();
  const std::array<float, 2> depths{static_cast<float>(depths_mm.lo),
                                    static_cast<float>(depths_mm.hi)};
  for (const ShellDraw& draw : pass.draws) {
    const bool compare_tools = draw.tools == ToolCut::Texture;
    const Program& wanted = program({draw.cut_by_slab || compare_tools, compare_tools});
    wanted.program.use(tile);
    gl_->uniform_2fv(wanted.depths, 1, depths.data());
    set_faces(*gl_, draw.faces);
    shells.draw(draw.shell);
  }
}

}  // namespace nacre

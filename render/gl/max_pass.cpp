#include "render/gl/max_pass.h"

#include <GL/glcorearb.h>

#include <array>
#include <string>

namespace nacre {
namespace {

// Where there is nothing to cut or write, the depth is all there is.
constexpr const char* kFragmentSource = R"(
uniform vec2 remap;   // depth at z = 0 and at z = 1
uniform vec2 values;  // brightness there
#ifdef COLOR
out float brightness;
#endif

void main() {
#if defined(SLAB) || defined(TOOLS)
  if (outside_ray()) discard;
#endif
#ifdef DEPTH
  gl_FragDepth = mix(remap.x, remap.y, depth_z());
#endif
#ifdef COLOR
  brightness = mix(values.x, values.y, depth_z());
#endif
}
)";

}  // namespace

MaxPass::Work MaxPass::work_for(const Pass& pass, const ShellDraw& draw, bool perspective) {
  return {draw.cut_by_slab, draw.tools == ToolCut::Texture,
          perspective && draw.depth_at_near != draw.depth_at_far, pass.kind == PassKind::MaxColor};
}

const MaxPass::Program& MaxPass::program(const Work& work) {
  const auto found = programs_.find(work);
  if (found != programs_.end()) return found->second;
  std::string defines;
  if (work.cut_by_slab) defines += "#define SLAB\n";
  if (work.compare_tools) defines += "#define TOOLS\n";
  if (work.write_depth) defines += "#define DEPTH\n";
  if (work.write_color) defines += "#define COLOR\n";
  FrameProgram made(*gl_, kFragmentSource, defines);
  const int remap = made.uniform("remap");
  const int values = made.uniform("values");
  return programs_.emplace(work, Program{std::move(made), remap, values}).first->second;
}

void MaxPass::use(const Work& work, const ShellDraw& draw, const TileFrame& tile) {
  const Program& wanted = program(work);
  if (used_ != &wanted) wanted.program.use(tile);
  used_ = &wanted;
  const std::array<float, 2> remap{static_cast<float>(draw.depth_at_far),
                                   static_cast<float>(draw.depth_at_near)};
  const std::array<float, 2> values{static_cast<float>(draw.value_at_far),
                                    static_cast<float>(draw.value_at_near)};
  gl_->uniform_2fv(wanted.remap, 1, remap.data());
  gl_->uniform_2fv(wanted.values, 1, values.data());
  // Depths written per fragment are final: the range only has to let them be.
  work.write_depth ? gl_->depth_range(0.0, 1.0)
                   : gl_->depth_range(draw.depth_at_near, draw.depth_at_far);
}

void MaxPass::draw_tools(const Pass& pass, const ShellDraw& draw, const ToolBuffers& tools,
                         const TileFrame& tile) {
  use({.write_depth = tile.perspective}, draw, tile);
  gl_->draw_buffer(GL_NONE);
  set_faces(*gl_, Faces::Both);
  tools.bind();
  for (const std::uint32_t tool : pass.tools) tools.draw(tool);
  gl_->draw_buffer(GL_COLOR_ATTACHMENT0);
}

void MaxPass::draw(const Pass& pass, const ShellBuffers& shells, const ToolBuffers* tools,
                   const TileFrame& tile) {
  gl_->disable(GL_BLEND);
  gl_->enable(GL_DEPTH_TEST);
  gl_->depth_func(GL_GREATER);
  set_near_plane(*gl_, tile.perspective);
  used_ = nullptr;  // uniforms of another tile or picture
  shells.bind();
  for (const ShellDraw& draw : pass.draws) {
    if (draw.tools == ToolCut::Passes && tools != nullptr) {
      draw_tools(pass, draw, *tools, tile);
      shells.bind();
    }
    use(work_for(pass, draw, tile.perspective), draw, tile);
    set_faces(*gl_, draw.faces);
    shells.draw(draw.shell);
  }
}

}  // namespace nacre

#include "render/gl/max_pass.h"

#include <GL/glcorearb.h>

#include <glm/gtc/type_ptr.hpp>

namespace nacre {
namespace {

constexpr const char* kVertexSource = R"(#version 330 core
layout(location = 0) in vec3 position_mm;
uniform mat4 clip_from_local;
void main() { gl_Position = clip_from_local * vec4(position_mm, 1.0); }
)";

// The depth is all there is to write.
constexpr const char* kFragmentSource = R"(#version 330 core
void main() {}
)";

}  // namespace

MaxPass::MaxPass(const GlFunctions& gl)
    : gl_(&gl),
      program_(make_program(gl, kVertexSource, kFragmentSource)),
      clip_from_local_(gl.get_uniform_location(program_.id(), "clip_from_local")) {}

void MaxPass::set_faces(Faces faces) const {
  if (faces == Faces::Both) {
    gl_->disable(GL_CULL_FACE);
    return;
  }
  gl_->enable(GL_CULL_FACE);
  gl_->cull_face(faces == Faces::Front ? GL_BACK : GL_FRONT);
}

void MaxPass::draw(const Pass& pass, const ShellBuffers& shells, const glm::mat4& clip_from_local,
                   bool perspective) const {
  gl_->use_program(program_.id());
  gl_->uniform_matrix_4fv(clip_from_local_, 1, GL_FALSE, glm::value_ptr(clip_from_local));
  gl_->enable(GL_DEPTH_TEST);
  gl_->depth_func(GL_GREATER);
  gl_->front_face(GL_CW);  // y points down in clip coordinates
  // An orthographic eye is infinitely far: nothing is behind it.
  perspective ? gl_->disable(GL_DEPTH_CLAMP) : gl_->enable(GL_DEPTH_CLAMP);
  shells.bind();
  for (const ShellDraw& draw : pass.draws) {
    set_faces(draw.faces);
    gl_->depth_range(draw.depth_at_near, draw.depth_at_far);
    shells.draw(draw.shell);
  }
}

}  // namespace nacre

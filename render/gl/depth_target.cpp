#include "render/gl/depth_target.h"

#include <GL/glcorearb.h>
#include <fmt/core.h>

#include "core/error.h"

namespace nacre {
namespace {

unsigned internal_format(DepthFormat format) {
  switch (format) {
    case DepthFormat::D16: return GL_DEPTH_COMPONENT16;
    case DepthFormat::D24: return GL_DEPTH_COMPONENT24;
    case DepthFormat::D32F: break;
  }
  return GL_DEPTH_COMPONENT32F;
}

}  // namespace

DepthTarget::DepthTarget(const GlFunctions& gl, const glm::ivec2& size, DepthFormat format)
    : gl_(&gl),
      size_(size),
      format_(format),
      depth_(make_renderbuffer(gl)),
      framebuffer_(make_framebuffer(gl)) {
  gl.bind_renderbuffer(GL_RENDERBUFFER, depth_.id());
  gl.renderbuffer_storage(GL_RENDERBUFFER, internal_format(format), size.x, size.y);
  check_gl(gl, "depth buffer");
  gl.bind_framebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  gl.framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  gl.draw_buffer(GL_NONE);
  gl.read_buffer(GL_NONE);
  const unsigned status = gl.check_framebuffer_status(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("depth buffer {} of {} x {} pixels: refused by the driver ({:#x})",
                            name(format), size.x, size.y, status));
  }
}

void DepthTarget::begin(const glm::ivec2& viewport) const {
  gl_->bind_framebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  gl_->viewport(0, 0, viewport.x, viewport.y);
  gl_->clear_depth(0.0);
  gl_->clear(GL_DEPTH_BUFFER_BIT);
}

void DepthTarget::read(const glm::ivec2& size, float* depths, int row_length) const {
  gl_->pixel_storei(GL_PACK_ROW_LENGTH, row_length);
  gl_->read_pixels(0, 0, size.x, size.y, GL_DEPTH_COMPONENT, GL_FLOAT, depths);
}

}  // namespace nacre

#include "render/gl/render_target.h"

#include <GL/glcorearb.h>
#include <fmt/core.h>

#include <glm/gtc/type_ptr.hpp>

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

int internal_format(ColorFormat format) {
  switch (format) {
    case ColorFormat::R8: return GL_R8;
    case ColorFormat::R16F: return GL_R16F;
    case ColorFormat::R32F: return GL_R32F;
    case ColorFormat::Rgba32F: break;
  }
  return GL_RGBA32F;
}

std::size_t bytes_of(DepthFormat format) { return format == DepthFormat::D16 ? 2 : 4; }

std::size_t bytes_of(ColorFormat format) {
  switch (format) {
    case ColorFormat::R8: return 1;
    case ColorFormat::R16F: return 2;
    case ColorFormat::R32F: return 4;
    case ColorFormat::Rgba32F: break;
  }
  return 16;
}

}  // namespace

RenderTarget::RenderTarget(const GlFunctions& gl, const glm::ivec2& size,
                           const TargetLayout& layout)
    : gl_(&gl), size_(size), layout_(layout), framebuffer_(make_framebuffer(gl)) {
  gl.bind_framebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  if (layout.color) attach_color(*layout.color);
  if (layout.depth) attach_depth(*layout.depth);
  gl.draw_buffer(layout.color ? GL_COLOR_ATTACHMENT0 : GL_NONE);
  gl.read_buffer(layout.color ? GL_COLOR_ATTACHMENT0 : GL_NONE);
  const unsigned status = gl.check_framebuffer_status(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("target of {} x {} pixels, depth {}, colour {}: "
                            "refused by the driver ({:#x})",
                            size.x, size.y, layout.depth ? name(*layout.depth) : "none",
                            layout.color ? "float" : "none", status));
  }
}

void RenderTarget::attach_color(ColorFormat format) {
  color_ = make_texture(*gl_);
  gl_->bind_texture(GL_TEXTURE_2D, color_.id());
  gl_->tex_image_2d(GL_TEXTURE_2D, 0, internal_format(format), size_.x, size_.y, 0, GL_RED,
                    GL_FLOAT, nullptr);
  check_gl(*gl_, "colour target");
  gl_->tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl_->tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl_->framebuffer_texture_2d(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
  gl_->bind_texture(GL_TEXTURE_2D, 0);
}

void RenderTarget::attach_depth(DepthFormat format) {
  depth_ = make_renderbuffer(*gl_);
  gl_->bind_renderbuffer(GL_RENDERBUFFER, depth_.id());
  gl_->renderbuffer_storage(GL_RENDERBUFFER, internal_format(format), size_.x, size_.y);
  check_gl(*gl_, "depth buffer");
  gl_->framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
}

std::size_t RenderTarget::bytes() const noexcept {
  const std::size_t pixels = static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y);
  return pixels * ((layout_.color ? bytes_of(*layout_.color) : 0) +
                   (layout_.depth ? bytes_of(*layout_.depth) : 0));
}

void RenderTarget::begin(const glm::ivec2& viewport, float depth, const glm::vec4& color) const {
  gl_->bind_framebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  gl_->viewport(0, 0, viewport.x, viewport.y);
  if (layout_.color) gl_->clear_buffer_fv(GL_COLOR, 0, glm::value_ptr(color));
  if (layout_.depth) gl_->clear_buffer_fv(GL_DEPTH, 0, &depth);
}

void RenderTarget::read(const glm::ivec2& size, unsigned format, float* values,
                        int row_length) const {
  gl_->bind_framebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  gl_->pixel_storei(GL_PACK_ROW_LENGTH, row_length);
  gl_->read_pixels(0, 0, size.x, size.y, format, GL_FLOAT, values);
}

void RenderTarget::read_depth(const glm::ivec2& size, float* depths, int row_length) const {
  read(size, GL_DEPTH_COMPONENT, depths, row_length);
}

void RenderTarget::read_red(const glm::ivec2& size, float* values, int row_length) const {
  read(size, GL_RED, values, row_length);
}

void RenderTarget::read_rgba(const glm::ivec2& size, glm::vec4* colors) const {
  read(size, GL_RGBA, glm::value_ptr(*colors), size.x);
}

}  // namespace nacre

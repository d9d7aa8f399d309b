#include "render/gl/gl_renderer.h"

#include <GL/glcorearb.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.h"
#include "render/gl/gl_functions.h"
#include "render/gl/picture_drawing.h"
#include "render/gl/shell_buffers.h"
#include "render/gl/tool_buffers.h"

namespace nacre {
namespace {

using Clock = std::chrono::steady_clock;

/// Larger targets are drawn in tiles even where the driver has them: 256 MB of depth.
constexpr int kMaxTargetSide = 8192;

Capabilities query_capabilities(const GlFunctions& gl) {
  int renderbuffer = 0;
  std::array<int, 2> viewport{};
  gl.get_integerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer);
  gl.get_integerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  return {std::min({kMaxTargetSide, renderbuffer, viewport[0], viewport[1]})};
}

}  // namespace

/// A context and all that was made in it. Members are destroyed last first, so that the context is
/// current until all its objects are gone.
class GlRenderer::Drawing {
 public:
  explicit Drawing(Backend backend)
      : opened_(open_backend(backend)),
        current_(std::in_place, *opened_.context),
        gl_(load_gl_functions(*opened_.context)),
        capabilities_(query_capabilities(gl_)),
        pictures_(gl_) {
    gl_.pixel_storei(GL_PACK_ALIGNMENT, 4);
    check_gl(gl_, "setting up");
    current_.reset();
  }

  ~Drawing() {
    // Objects go with the context; a driver that refuses now has lost them already.
    try {
      current_.emplace(*opened_.context);
    } catch (const Error&) {
    }
  }

  void upload(const ShellSet& set, SceneFacts facts, std::span<const std::uint32_t> shells,
              const UploadOptions& options) {
    const CurrentContext current(*opened_.context);
    shells_.reset();
    tools_.reset();
    scene_ = {};  // what stays if there is no room for the new set
    shells_.emplace(gl_, set, shells, options.normals);
    scene_ = std::move(facts);
    scene_.tools.clear();
  }

  void upload_tools(std::span<const Tool> tools) {
    const CurrentContext current(*opened_.context);
    tools_.reset();
    scene_.tools.clear();
    tools_.emplace(gl_, tools, scene_.center_mm);
    for (const Tool& tool : tools) scene_.tools.push_back(tool_facts(tool, scene_.center_mm));
  }

  Picture render(const Camera& camera, const Plan& plan) {
    check(plan);
    const CurrentContext current(*opened_.context);
    const Clock::time_point start = Clock::now();
    Picture picture = pictures_.draw(
        camera, plan, {scene_.center_mm, pointer(shells_), pointer(tools_)}, memory_);
    finish_picture(plan, picture, memory_);
    frame_ = pictures_.stats();
    frame_.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return picture;
  }

  const BackendInfo& info() const { return opened_.info; }
  const Capabilities& capabilities() const { return capabilities_; }
  const SceneFacts& scene() const { return scene_; }
  const FrameStats& frame() const { return frame_; }
  std::size_t bytes() const {
    return (shells_ ? shells_->bytes() : 0) + (tools_ ? tools_->bytes() : 0);
  }

 private:
  template <class Buffers>
  static const Buffers* pointer(const std::optional<Buffers>& buffers) {
    return buffers ? &*buffers : nullptr;
  }

  void check(const Plan& plan) const {
    for (const Pass& pass : plan.passes) {
      for (const ShellDraw& draw : pass.draws) {
        if (!shells_ || !shells_->holds(draw.shell)) refuse("shell", draw.shell);
      }
      for (const std::uint32_t tool : pass.tools) {
        if (!tools_ || !tools_->holds(tool)) refuse("tool", tool);
      }
      if (pass.kind == PassKind::Lit && !shells_->has_normals()) {
        throw Error(ErrorCode::BadArgument,
                    "lit shells: found none of their normals, expected them uploaded before");
      }
    }
  }

  [[noreturn]] static void refuse(std::string_view what, std::uint32_t index) {
    throw Error(
        ErrorCode::BadArgument,
        fmt::format("{} {}: found in the plan, expected it uploaded before", what, index + 1));
  }

  OpenBackend opened_;
  std::optional<CurrentContext> current_;  // set while objects are made and destroyed
  GlFunctions gl_;
  Capabilities capabilities_;
  PictureDrawing pictures_;
  PictureMemory memory_;
  std::optional<ShellBuffers> shells_;
  std::optional<ToolBuffers> tools_;
  SceneFacts scene_;
  FrameStats frame_;
};

GlRenderer::GlRenderer(Backend backend) : drawing_(std::make_unique<Drawing>(backend)) {}
GlRenderer::~GlRenderer() = default;
GlRenderer::GlRenderer(GlRenderer&&) noexcept = default;
GlRenderer& GlRenderer::operator=(GlRenderer&&) noexcept = default;

const BackendInfo& GlRenderer::info() const noexcept { return drawing_->info(); }

std::string_view GlRenderer::backend_name() const noexcept { return name(info().backend); }

std::string GlRenderer::device_name() const { return info().renderer; }

const Capabilities& GlRenderer::capabilities() const noexcept { return drawing_->capabilities(); }

void GlRenderer::upload(const ShellSet& set, const UploadOptions& options) {
  std::vector<std::uint32_t> all(set.shells.size());
  std::iota(all.begin(), all.end(), 0U);
  drawing_->upload(set, scene_facts(set), all, options);
}

void GlRenderer::upload(const ShellSet& set, const SceneFacts& facts,
                        std::span<const std::uint32_t> shells, const UploadOptions& options) {
  check_upload(set, facts, shells);
  drawing_->upload(set, facts, shells, options);
}

void GlRenderer::upload_tools(std::span<const Tool> tools) { drawing_->upload_tools(tools); }

std::size_t GlRenderer::uploaded_bytes() const noexcept { return drawing_->bytes(); }

Picture GlRenderer::render(const Camera& camera, const RenderOptions& options) {
  return render(camera, make_plan(drawing_->scene(), camera, options, capabilities()));
}

Picture GlRenderer::render(const Camera& camera, const Plan& plan) {
  return drawing_->render(camera, plan);
}

const FrameStats& GlRenderer::last_frame() const noexcept { return drawing_->frame(); }

}  // namespace nacre

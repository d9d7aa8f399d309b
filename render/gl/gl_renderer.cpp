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
#include "render/gl/depth_target.h"
#include "render/gl/gl_functions.h"
#include "render/gl/max_pass.h"
#include "render/gl/shell_buffers.h"
#include "render/projection.h"

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

/// Turns depths d = rank / n, in place, into the emission each rank stands for.
void look_up(std::span<float> depths, const std::vector<float>& emission_of_rank) {
  const auto ranks = static_cast<float>(emission_of_rank.size() - 1);
  const float half = 0.5F;  // to the nearest; std::lround is a call a pixel
  for (float& depth : depths) {
    depth = emission_of_rank[static_cast<std::size_t>(depth * ranks + half)];
  }
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
        max_pass_(gl_) {
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

  void upload(const ShellSet& set, SceneFacts facts, std::span<const std::uint32_t> shells) {
    const CurrentContext current(*opened_.context);
    buffers_.reset();
    scene_ = {};  // what stays if there is no room for the new set
    buffers_.emplace(gl_, set, shells);
    scene_ = std::move(facts);
  }

  Image render(const Camera& camera, const Plan& plan) {
    Image image = make_image(camera.size.x, camera.size.y);
    const CurrentContext current(*opened_.context);
    const Clock::time_point start = Clock::now();
    frame_ = {};
    for (const Pass& pass : plan.passes) check(pass);
    if (!plan.passes.empty()) {
      // The first tile is the largest; the others use a part of its target.
      prepare_target({plan.tiles.front().width, plan.tiles.front().height}, plan.depth);
      for (const PixelRect& tile : plan.tiles) draw_tile(camera, plan, tile, image);
      look_up(image.pixels, plan.emission_of_rank);
      check_gl(gl_, "drawing");
    }
    frame_.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return image;
  }

  const BackendInfo& info() const { return opened_.info; }
  const Capabilities& capabilities() const { return capabilities_; }
  const SceneFacts& scene() const { return scene_; }
  const FrameStats& frame() const { return frame_; }
  std::size_t bytes() const { return buffers_ ? buffers_->bytes() : 0; }

 private:
  void check(const Pass& pass) const {
    for (const ShellDraw& draw : pass.draws) {
      if (!buffers_ || !buffers_->holds(draw.shell)) {
        throw Error(ErrorCode::BadArgument,
                    fmt::format("shell {}: found in the plan, expected it uploaded before",
                                draw.shell + 1));
      }
    }
  }

  void draw_tile(const Camera& camera, const Plan& plan, const PixelRect& tile, Image& image) {
    const glm::mat4 clip(clip_from_local(camera, scene_.center_mm, tile));
    target_->begin({tile.width, tile.height});
    for (const Pass& pass : plan.passes) {
      max_pass_.draw(pass, *buffers_, clip, camera.perspective);
      count(pass);
    }
    target_->read({tile.width, tile.height}, &image.at(tile.x, tile.y), image.width);
  }

  void count(const Pass& pass) {
    frame_.passes += 1;
    frame_.draws += pass.draws.size();
    for (const ShellDraw& draw : pass.draws) frame_.triangles += draw.triangles;
  }

  void prepare_target(const glm::ivec2& size, DepthFormat format) {
    if (target_ && target_->size() == size && target_->format() == format) return;
    target_.reset();
    target_.emplace(gl_, size, format);
  }

  OpenBackend opened_;
  std::optional<CurrentContext> current_;  // set while objects are made and destroyed
  GlFunctions gl_;
  Capabilities capabilities_;
  MaxPass max_pass_;
  std::optional<ShellBuffers> buffers_;
  std::optional<DepthTarget> target_;
  SceneFacts scene_;
  FrameStats frame_;
};

GlRenderer::GlRenderer(Backend backend) : drawing_(std::make_unique<Drawing>(backend)) {}
GlRenderer::~GlRenderer() = default;
GlRenderer::GlRenderer(GlRenderer&&) noexcept = default;
GlRenderer& GlRenderer::operator=(GlRenderer&&) noexcept = default;

const BackendInfo& GlRenderer::info() const noexcept { return drawing_->info(); }

const Capabilities& GlRenderer::capabilities() const noexcept { return drawing_->capabilities(); }

void GlRenderer::upload(const ShellSet& set) {
  std::vector<std::uint32_t> all(set.shells.size());
  std::iota(all.begin(), all.end(), 0U);
  drawing_->upload(set, scene_facts(set), all);
}

void GlRenderer::upload(const ShellSet& set, const SceneFacts& facts,
                        std::span<const std::uint32_t> shells) {
  for (const std::uint32_t shell : shells) {
    if (shell >= set.shells.size() || shell >= facts.shells.size()) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("shell {}: found {} in the set", shell + 1, set.shells.size()));
    }
    const std::size_t found = set.shells[shell].surface.triangles.size();
    if (found != facts.shells[shell].triangles) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("shell {}: found {} triangles, expected {}", shell + 1, found,
                              facts.shells[shell].triangles));
    }
  }
  drawing_->upload(set, facts, shells);
}

std::size_t GlRenderer::uploaded_bytes() const noexcept { return drawing_->bytes(); }

Image GlRenderer::render(const Camera& camera, const RenderOptions& options) {
  return render(camera, make_plan(drawing_->scene(), camera, options, capabilities()));
}

Image GlRenderer::render(const Camera& camera, const Plan& plan) {
  return drawing_->render(camera, plan);
}

const FrameStats& GlRenderer::last_frame() const noexcept { return drawing_->frame(); }

}  // namespace nacre

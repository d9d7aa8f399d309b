#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/camera.h"
#include "core/image.h"
#include "render/gl/crossings_pass.h"
#include "render/gl/gl_renderer.h"
#include "render/gl/lit_pass.h"
#include "render/gl/max_pass.h"
#include "render/gl/render_target.h"
#include "render/gl/shell_buffers.h"
#include "render/gl/tool_buffers.h"
#include "render/gl/tool_pass.h"
#include "render/plan.h"
#include "render/shell_renderer.h"

namespace nacre {

/// What is drawn: buffers that hold all that a plan asks for.
struct SceneBuffers {
  glm::dvec3 center_mm{0.0};
  const ShellBuffers* shells = nullptr;
  const ToolBuffers* tools = nullptr;
};

/// Runs a plan's passes tile by tile, and puts the picture together.
///
/// Keeps its programs and targets for the next picture.
class PictureDrawing {
 public:
  explicit PictureDrawing(const GlFunctions& gl);

  /// @pre            the context is current; the buffers hold what the plan draws
  /// @throws Error   Unsupported if the driver fails
  /// @return        its volume as large as what is drawn: `finish_picture` makes a picture of it
  Picture draw(const Camera& camera, const Plan& plan, const SceneBuffers& scene,
               PictureMemory& memory);

  /// Of the last picture, without its seconds.
  const FrameStats& stats() const noexcept { return stats_; }

 private:
  /// A tile while it is drawn, and what came of it besides the volume.
  struct Tile {
    PixelRect rect;
    TileFrame frame = {};
    std::vector<glm::vec4> tools = {};     ///< the tool layer, if there is one
    std::vector<float> start_counts = {};  ///< shells around the start of each ray, if counted
    std::vector<float> end_counts = {};    ///< and around its end
  };

  void draw_tile(const Camera& camera, const Plan& plan, const SceneBuffers& scene,
                 const PixelRect& rect, Picture& picture);
  void run(const Plan& plan, const Pass& pass, const SceneBuffers& scene, Tile& tile,
           Image& volume);
  void draw_tools(const Plan& plan, const Pass& pass, const ToolBuffers& tools, Tile& tile);
  void draw_counts(const Pass& pass, const ShellBuffers& shells, const Tile& tile,
                   std::vector<float>& counts);
  void draw_max(const Plan& plan, const Pass& pass, const SceneBuffers& scene, const Tile& tile,
                Image& volume);
  void draw_colors(const Plan& plan, const Pass& pass, const ShellBuffers& shells, const Tile& tile,
                   Image& volume);
  const RenderTarget& begin(std::optional<RenderTarget>& target, const TargetLayout& layout,
                            const PixelRect& rect, float depth, const glm::vec4& color);
  void count(const Pass& pass);

  const GlFunctions* gl_;
  MaxPass max_pass_;
  CrossingsPass crossings_pass_;
  LitPass lit_pass_;
  ToolPass tool_pass_;
  std::optional<RenderTarget> volume_target_;
  std::optional<RenderTarget> tool_target_;
  std::optional<RenderTarget> count_target_;
  glm::ivec2 largest_tile_{0};
  FrameStats stats_;
};

}  // namespace nacre

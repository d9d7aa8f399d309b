#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/camera.h"
#include "core/image.h"
#include "core/shell_set.h"
#include "core/tool.h"
#include "render/gl/backends.h"
#include "render/plan.h"
#include "render/render_options.h"

namespace nacre {

/// What the last picture cost.
struct FrameStats {
  std::size_t triangles = 0;     ///< sent to be drawn, over all passes and tiles
  std::size_t passes = 0;        ///< over all tiles
  std::size_t draws = 0;         ///< of shells and tools, over all tiles
  std::size_t target_bytes = 0;  ///< of all targets drawn to
  double seconds = 0.0;          ///< from the first command to the picture in memory
};

/// What of a set to copy to the context besides positions and triangles.
struct UploadOptions {
  bool normals = false;  ///< smooth normals, which lit pictures need: see `Plan::normals`
};

/// Draws shell sets and tools with OpenGL 3.3 core, in hardware or software, without a window.
///
/// The maximum projection is the depth buffer: [H96]'s z-remap puts emission (uncued: the rank of
/// a shell's representative) in the place of depth, the depth test keeps the greatest, and what is
/// read back is the picture. Sums and counts add up crossings by blending; lit shells and tools are
/// drawn with an ordinary depth test. Pixels are those of `picture_ray`.
///
/// Any number of renderers, of any backends, may live in one process, and be used from any thread,
/// each from one at a time. A call leaves the calling thread without a current context of its
/// backend.
class GlRenderer {
 public:
  /// Opens the backend's first context that works (see `open_backend`).
  /// @throws Error  Unsupported if none does
  explicit GlRenderer(Backend backend = Backend::Auto);
  ~GlRenderer();
  GlRenderer(GlRenderer&&) noexcept;
  GlRenderer& operator=(GlRenderer&&) noexcept;

  /// The context in use.
  const BackendInfo& info() const noexcept;

  /// What to plan for.
  const Capabilities& capabilities() const noexcept;

  /// Copies a set to the context, in place of what was there, tools included.
  /// @throws std::bad_alloc  if the driver has no room for it
  void upload(const ShellSet& set, const UploadOptions& options = {});

  /// The same with these shells only; the surfaces of others may be missing in `set`.
  ///
  /// @param facts   of the whole set, as a file's header or `scene_facts` gives them; those of
  /// tools
  ///                are ignored
  /// @param shells  indices; those that pictures will draw, see `shells_drawn`
  /// @throws Error  BadArgument for a shell that does not exist or has no such number of triangles
  void upload(const ShellSet& set, const SceneFacts& facts, std::span<const std::uint32_t> shells,
              const UploadOptions& options = {});

  /// Copies tools to the context, in place of those that were there, for pictures of the set
  /// uploaded.
  /// @throws std::bad_alloc  if the driver has no room for them
  void upload_tools(std::span<const Tool> tools);

  /// Bytes of vertices and indices the context holds, of shells and tools.
  std::size_t uploaded_bytes() const noexcept;

  /// The picture of what was uploaded: 0 where nothing of the volume shows, and the tools' layer if
  /// any is seen.
  /// @throws Error           as `make_plan` does; BadArgument for a lit picture of a set uploaded
  ///                         without normals; Unsupported if the driver fails
  /// @throws std::bad_alloc  if there is no room for the picture
  Picture render(const Camera& camera, const RenderOptions& options = {});

  /// The picture that the plan, made for this camera and what was uploaded, describes.
  /// @throws Error  also BadArgument if it draws a shell or tool that was not uploaded
  Picture render(const Camera& camera, const Plan& plan);

  /// Of the last picture; zeros before the first.
  const FrameStats& last_frame() const noexcept;

 private:
  class Drawing;
  std::unique_ptr<Drawing> drawing_;
};

}  // namespace nacre

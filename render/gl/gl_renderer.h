#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "render/gl/backends.h"
#include "render/render_options.h"
#include "render/shell_renderer.h"

namespace nacre {

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
class GlRenderer : public ShellRenderer {
 public:
  /// Opens the backend's first context that works (see `open_backend`).
  /// @throws Error  Unsupported if none does
  explicit GlRenderer(Backend backend = Backend::Auto);
  ~GlRenderer() override;
  GlRenderer(GlRenderer&&) noexcept;
  GlRenderer& operator=(GlRenderer&&) noexcept;

  /// The context in use.
  const BackendInfo& info() const noexcept;

  std::string_view backend_name() const noexcept override;
  std::string device_name() const override;
  const Capabilities& capabilities() const noexcept override;

  /// Copies a whole set to the context, in place of what was there, tools included.
  void upload(const ShellSet& set, const UploadOptions& options = {});

  void upload(const ShellSet& set, const SceneFacts& facts, std::span<const std::uint32_t> shells,
              const UploadOptions& options = {}) override;
  void upload_tools(std::span<const Tool> tools) override;
  std::size_t uploaded_bytes() const noexcept override;

  /// The picture of what was uploaded: 0 where nothing of the volume shows, and the tools' layer if
  /// any is seen.
  /// @throws Error  as `make_plan` does; BadArgument for a lit picture of a set uploaded without
  ///                normals; Unsupported if the driver fails
  Picture render(const Camera& camera, const RenderOptions& options = {});

  Picture render(const Camera& camera, const Plan& plan) override;
  const FrameStats& last_frame() const noexcept override;

 private:
  class Drawing;
  std::unique_ptr<Drawing> drawing_;
};

}  // namespace nacre

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "render/cpu/cluster_kernel.h"
#include "render/render_options.h"
#include "render/shell_renderer.h"

namespace nacre {

struct CpuOptions {
  /// Surfaces may be drawn with fewer triangles where no point of them moves by more than this many
  /// pixels; the outlines of shells then lie at most as far from where they belong. 0: all
  /// triangles, and no time spent on preparing others.
  double detail_px = 0.0;
  InstructionSet instructions = best_instruction_set();
};

/// Why `CpuRenderer` does not draw the pictures of this plan; nothing if it does. It draws maximum
/// projections, sums and counts, the latter two into targets of 32 bits; tools by texture, not by
/// passes.
std::optional<std::string> cpu_objection(const Plan& plan);

/// Draws maximum projections, sums and counts of shell sets on the processor, without OpenGL.
///
/// A maximum does not depend on the order of drawing, nor does a sum of whole numbers, so threads
/// share nothing: each raises the pixels of a picture of its own, or adds to them, and the greatest
/// or the sum of them is the picture. The same bytes for any number of threads and for all
/// instruction sets. Pixels are those of `GlRenderer`, but for corners that floats put to either
/// side of a sub-pixel.
///
/// Uses all threads of the calling TBB arena. A renderer is used from one thread at a time.
class CpuRenderer : public ShellRenderer {
 public:
  explicit CpuRenderer(const CpuOptions& options = {});
  ~CpuRenderer() override;
  CpuRenderer(CpuRenderer&&) noexcept;
  CpuRenderer& operator=(CpuRenderer&&) noexcept;

  std::string_view backend_name() const noexcept override;
  std::string device_name() const override;
  const Capabilities& capabilities() const noexcept override;

  /// Prepares a whole set for drawing, in place of what was there: cuts it into clusters. The set
  /// is not needed afterwards.
  void upload(const ShellSet& set);

  void upload(const ShellSet& set, const SceneFacts& facts, std::span<const std::uint32_t> shells,
              const UploadOptions& options = {}) override;

  void upload_tools(std::span<const Tool> tools) override;

  std::size_t uploaded_bytes() const noexcept override;

  /// The picture of the uploaded set: 0 where nothing of the volume shows.
  /// @throws Error  as `make_plan` does; Unsupported where `cpu_objection` has one
  Picture render(const Camera& camera, const RenderOptions& options = {});

  Picture render(const Camera& camera, const Plan& plan) override;
  const FrameStats& last_frame() const noexcept override;

 private:
  class Drawing;
  std::unique_ptr<Drawing> drawing_;
};

}  // namespace nacre

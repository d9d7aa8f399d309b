#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/camera.h"
#include "core/image.h"
#include "core/shell_set.h"
#include "render/cpu/cluster_kernel.h"
#include "render/plan.h"
#include "render/render_options.h"

namespace nacre {

struct CpuOptions {
  /// Surfaces may be drawn with fewer triangles where no point of them moves by more than this many
  /// pixels; the outlines of shells then lie at most as far from where they belong. 0: all
  /// triangles, and no time spent on preparing others.
  double detail_px = 0.0;
  InstructionSet instructions = best_instruction_set();
};

/// What the last picture cost.
struct CpuFrameStats {
  std::size_t clusters = 0;  ///< of the shells drawn, at the level of detail that they are drawn in
  std::size_t triangles = 0;  ///< of clusters that were not rejected as a whole
  double seconds = 0.0;       ///< from the first command to the picture in memory
};

/// Draws maximum projections of shell sets on the processor, without OpenGL.
///
/// A maximum does not depend on the order of drawing, so threads share nothing: each raises the
/// pixels of a picture of its own, and the greatest of them is the picture. The same bytes for any
/// number of threads and for all instruction sets. Pixels are those of `GlRenderer`, but for
/// corners that floats put to either side of a sub-pixel.
///
/// Uses all threads of the calling TBB arena. A renderer is used from one thread at a time.
class CpuRenderer {
 public:
  explicit CpuRenderer(const CpuOptions& options = {});
  ~CpuRenderer();
  CpuRenderer(CpuRenderer&&) noexcept;
  CpuRenderer& operator=(CpuRenderer&&) noexcept;

  /// What to plan for.
  const Capabilities& capabilities() const noexcept;

  /// Prepares a set for drawing, in place of what was there: cuts it into clusters. The set is not
  /// needed afterwards.
  void upload(const ShellSet& set);

  /// The same with these shells only; the surfaces of others may be missing in `set`.
  ///
  /// @param facts   of the whole set, as a file's header or `scene_facts` gives them
  /// @param shells  indices; those that pictures will draw, see `shells_drawn`
  /// @throws Error  BadArgument for a shell that does not exist or has no such number of triangles
  void upload(const ShellSet& set, const SceneFacts& facts, std::span<const std::uint32_t> shells);

  /// Bytes of vertices and triangles held.
  std::size_t uploaded_bytes() const noexcept;

  /// The picture of the uploaded set: emission, 0 where there is nothing.
  /// @throws Error  as `make_plan` does
  Image render(const Camera& camera, const RenderOptions& options = {});

  /// The picture that the plan, made for this camera and the uploaded set, describes.
  /// @throws Error  BadArgument if it draws a shell that was not uploaded, Unsupported for more
  ///                than 65535 ranks
  Image render(const Camera& camera, const Plan& plan);

  /// Of the last picture; zeros before the first.
  const CpuFrameStats& last_frame() const noexcept;

 private:
  class Drawing;
  std::unique_ptr<Drawing> drawing_;
};

}  // namespace nacre

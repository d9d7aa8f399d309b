#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/camera.h"
#include "core/image.h"
#include "core/shell_set.h"
#include "core/tool.h"
#include "render/plan.h"
#include "render/scene_facts.h"

namespace nacre {

/// What the last picture cost.
struct FrameStats {
  std::size_t triangles = 0;     ///< sent to be drawn, over all passes and tiles
  std::size_t passes = 0;        ///< over all tiles
  std::size_t draws = 0;         ///< of shells and tools, over all tiles
  std::size_t target_bytes = 0;  ///< of all targets drawn to
  double seconds = 0.0;          ///< from the first command to the picture in memory
};

/// What of a set to copy to the renderer besides positions and triangles.
struct UploadOptions {
  bool normals = false;  ///< smooth normals, which lit pictures need: see `Plan::normals`
};

/// What draws the pictures that plans describe.
///
/// A renderer is used from one thread at a time.
class ShellRenderer {
 public:
  virtual ~ShellRenderer() = default;

  /// As `--backend` has it: "egl", "osmesa", "cpu".
  virtual std::string_view backend_name() const noexcept = 0;

  /// What does the drawing, for the user: "llvmpipe (LLVM 15.0.6, 256 bits)".
  virtual std::string device_name() const = 0;

  /// What to plan for.
  virtual const Capabilities& capabilities() const noexcept = 0;

  /// Takes these shells of a set, in place of what was there, tools included; the surfaces of
  /// others may be missing in `set`.
  ///
  /// @param facts   of the whole set, as a file's header or `scene_facts` gives them; those of
  ///                tools are ignored
  /// @param shells  indices; those that pictures will draw, see `shells_drawn`
  /// @throws Error  BadArgument for a shell that does not exist or has no such number of triangles
  /// @throws std::bad_alloc  if there is no room for it
  virtual void upload(const ShellSet& set, const SceneFacts& facts,
                      std::span<const std::uint32_t> shells, const UploadOptions& options) = 0;

  /// Takes tools, in place of those that were there, for pictures of the set uploaded.
  /// @throws std::bad_alloc  if there is no room for them
  virtual void upload_tools(std::span<const Tool> tools) = 0;

  /// Bytes of vertices and triangles held, of shells and tools.
  virtual std::size_t uploaded_bytes() const noexcept = 0;

  /// The picture that the plan, made for this camera and what was uploaded, describes.
  /// @throws Error           BadArgument if it draws what was not uploaded; Unsupported if the
  ///                         renderer fails or does not draw such plans
  /// @throws std::bad_alloc  if there is no room for the picture
  virtual Picture render(const Camera& camera, const Plan& plan) = 0;

  /// Of the last picture; zeros before the first.
  virtual const FrameStats& last_frame() const noexcept = 0;

 protected:
  ShellRenderer() = default;
  ShellRenderer(const ShellRenderer&) = default;
  ShellRenderer& operator=(const ShellRenderer&) = default;
  ShellRenderer(ShellRenderer&&) = default;
  ShellRenderer& operator=(ShellRenderer&&) = default;
};

/// What a renderer keeps from picture to picture: new memory for each would cost more than what is
/// done in it.
struct PictureMemory {
  DequantizationMemory layers;
  Image samples;  ///< a picture as it is drawn, where that is larger than the one that is shown
};

/// A black picture to draw on: as large as the camera's, times the plan's samples.
Image blank_samples(const Camera& camera, const Plan& plan, PictureMemory& memory);

/// What is done to a picture once it is drawn, its volume on `blank_samples`: what lies beyond the
/// volume's box goes, and a maximum is estimated between its levels, where that is planned. The
/// background stays black where a tool is seen, and beyond the box.
void finish_picture(const Plan& plan, Picture& picture, PictureMemory& memory,
                    const RowLoop& rows = {});

/// Checks what is to be uploaded.
/// @throws Error  BadArgument for a shell that does not exist or has no such number of triangles
void check_upload(const ShellSet& set, const SceneFacts& facts,
                  std::span<const std::uint32_t> shells);

}  // namespace nacre

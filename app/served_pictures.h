#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "app/page_server.h"

namespace nacre {

/// The pictures of a shell set that its page asks for where the browser would draw in software:
/// drawn by the processor (`CpuRenderer`), some ten times as fast. From any thread; one at a time.
class ServedPictures {
 public:
  /// Shells are decoded when the first picture is asked for.
  /// @param set  the bytes of a shell file that has been looked through; outlive this object
  explicit ServedPictures(std::span<const std::byte> set);
  ~ServedPictures();
  ServedPictures(const ServedPictures&) = delete;
  ServedPictures& operator=(const ServedPictures&) = delete;

  /// A picture as `nacre render` draws it with those flags, --colormap and tools left out: a byte a
  /// pixel, from 0 at the display window's low end to 255 at its high one, the upper row first,
  /// packed by `pack_runs`.
  ///
  /// @param request  --size (up to `kMostServedSide` a side), --mode, camera, slab, cue, --hide,
  ///                 --layers and --display; no other flag is taken, none that names a file
  /// @throws Error   BadArgument for what the flags cannot mean; Unsupported for what the processor
  ///                 does not draw; BadFile for shells that are damaged
  std::vector<std::byte> draw(const PictureRequest& request);

 private:
  class Drawing;
  std::unique_ptr<Drawing> drawing_;
};

/// Bytes in which zeros come in long runs, as the dark of a maximum does: how many zeros, how many
/// others (both in two bytes, the lower first), then those others; again until all are said. A
/// browser takes longer to receive a picture than the processor to draw it.
std::vector<std::byte> pack_runs(std::span<const std::byte> bytes);

/// Pixels: more than any screen has. A picture of that size takes half a GB.
inline constexpr int kMostServedSide = 8192;

}  // namespace nacre

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/image.h"
#include "io/atomic_file.h"

namespace nacre {

/// Writes an animated PNG (PNG specification, third edition, section 11.3.3: acTL, fcTL, fdAT),
/// which plays on and on; programs that know no animation show its first frame. The file appears
/// under its name only when it is whole.
class ApngWriter {
 public:
  /// @param frames    how many there will be, 1 or more
  /// @param delay_ms  how long each is shown, 0 to 65535
  /// @param bits      8 (samples are rounded from 16) or 16 a channel
  /// @throws Error    BadArgument for a name that cannot be written to, or numbers out of range
  ApngWriter(const std::filesystem::path& path, std::size_t frames, int delay_ms, int bits = 8);

  /// Appends a frame.
  /// @throws Error  BadArgument unless it has the size and channels of the first one, or if there
  ///                are too many
  void add(const DisplayImage& frame);

  /// Ends the file, and gives it its name.
  /// @throws Error  BadArgument if frames are missing
  void commit();

 private:
  void write_frame_control(const DisplayImage& frame);

  std::filesystem::path path_;
  AtomicFile file_;
  std::uint32_t frames_;
  std::uint16_t delay_ms_;
  int bits_;
  std::uint32_t added_ = 0;
  std::uint32_t sequence_ = 0;  ///< number of the next fcTL or fdAT
  std::string header_;          ///< data of the first frame's IHDR
};

}  // namespace nacre

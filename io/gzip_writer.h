#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "io/atomic_file.h"

namespace nacre {

/// Writes one gzip stream into a file.
class GzipWriter {
 public:
  /// @param file  must outlive the writer
  explicit GzipWriter(AtomicFile& file);
  ~GzipWriter();
  GzipWriter(const GzipWriter&) = delete;
  GzipWriter& operator=(const GzipWriter&) = delete;

  /// @throws Error  Unsupported if the packed bytes cannot be written
  void write(std::span<const std::byte> bytes);

  /// Writes what is left and the checksum; nothing may be written afterwards.
  /// @throws Error  as `write`
  void finish();

 private:
  class Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace nacre
